"""Lets fragments fly: from a run of blasting to the numbers of its muck pile."""

from pathlib import Path

from sazare.folders import own
from sazare.muck_pile import words
from sazare.muck_pile.breaking import breaking_of
from sazare.muck_pile.folders import claim
from sazare.muck_pile.model import model_of
from sazare.muck_pile.numbers import PileNumbers, write_numbers
from sazare.simulation import build, check


def muck_pile(results, out=None, options=None, *, threads=0, overwrite=False, progress=False, say=None):
    """The PileNumbers of a run of blasting (`sazare.open`), whose fragments fly and land in a run of method spheres.

    out: a folder for tables, the case and its run; `muck-pile` in that of the run of blasting where it is None.
    options: sazare.muck_pile.Options. say: a function that takes lines of words about the model and its run.

    Raises ValueError for a run that has no pile, NotARun for a damaged one, Occupied where the folder holds something, UserError and MachineError as
    `sazare.run`.
    """
    say = say or (lambda lines: None)
    folder = Path(out) if out else own(results.path / "muck-pile")
    model = model_of(results, options)
    claim(folder, results.path, overwrite)
    say(words.before(model, breaking_of(results)))
    model.write(folder, f"Muck pile of {results.title}")
    case = folder / "case.toml"
    say(words.flight(check(case), model.end))
    with build(case, folder / "run", threads=threads, overwrite=overwrite, progress=progress, warns=False) as simulation:
        simulation.run()
        simulation.stop()
        flown = simulation.results
    numbers = PileNumbers(results, model, flown)
    write_numbers(numbers, folder)
    return numbers
