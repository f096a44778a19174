"""What a user has said of a blast beside its case: the size above which fragments are too large, the masses of charges, and which holes are those of the contour."""

import json
import math
from dataclasses import dataclass

from sazare.folders import own
from sazare.tables import NotARun

FILE = "settings.json"


@dataclass(frozen=True)
class Settings:
    """oversize: the size [m] above which a fragment is too large, None where nobody said it. charges: masses [kg], one for all holes or one for each in the
    order of the case; empty where nobody said them. contour: names of the contour holes, or patterns such as `rim_*`; empty for all holes."""

    oversize: float | None = None
    charges: tuple[float, ...] = ()
    contour: tuple[str, ...] = ()


def folder_of(results):
    """The folder of a run's numbers of the blast. Raises NotARun where it is a link."""
    return own(results.path / "blast")


def read_settings(results):
    """The Settings that `sazare blast` was last given for a run; those of nobody where it was not used. Raises NotARun for a damaged file."""
    path = folder_of(results) / FILE
    if not own(path).is_file():
        return Settings()
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        settings = Settings(found["oversize"], tuple(found["charges"]), tuple(found.get("contour", ())))
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise NotARun(f"{path}: not what sazare blast writes: {error}") from error
    numbers = [*settings.charges, *([] if settings.oversize is None else [settings.oversize])]
    if not all(isinstance(number, int | float) and math.isfinite(number) and number > 0.0 for number in numbers):
        raise NotARun(f"{path}: sizes and masses must be numbers above 0")
    if not all(isinstance(name, str) for name in settings.contour):
        raise NotARun(f"{path}: names of contour holes must be texts")
    return settings


def write_settings(results, settings):
    """Keeps Settings beside the numbers, so that the report uses them too."""
    folder = folder_of(results)
    folder.mkdir(exist_ok=True)
    own(folder / FILE).write_text(json.dumps({"oversize": settings.oversize, "charges": list(settings.charges), "contour": list(settings.contour)}, indent=2) + "\n", encoding="utf-8")
