"""The headline figures of a run in words, for the top of the report and for the terminal."""

from sazare.methods import Headline, method_of
from sazare.methods.common import energy_balance, is_round_off
from sazare.style import quantity


def verdict(results):
    """("good", "fair" or "bad", sentence) about the run as a whole."""
    status = results.manifest.get("status")
    if status is None:
        return "fair", "The run has not written its manifest: it is still running or was interrupted."
    if status == "running":
        return "fair", "The run is still running or was interrupted. The results below are partial."
    if status != "done":
        return "bad", f"The run ended early with status “{status}”. The results below are partial."
    return method_of(results).verdict(results)


def headlines(results):
    """The figures for the top of the report (list of Headline); those the run did not write are left out."""
    figures, method = results.figures, method_of(results)
    found = [*method.measured(results), *(figure.headline(figures) for figure in method.headlines)]
    balance = energy_balance(figures)
    if balance is not None and not is_round_off(results):
        found.append(Headline("energy balance", f"{balance:.1e}", "relative residual"))
    if figures.get("wall_seconds") is not None:
        found.append(Headline("wall-clock time", quantity(figures["wall_seconds"], "s"), _machine(results.manifest)))
    return [headline for headline in found if headline is not None]


def _machine(manifest):
    threads = manifest.get("machine", {}).get("threads")
    return "" if threads is None else f"{threads} thread{'s' if threads != 1 else ''}"


def terminal_text(results):
    """The headline figures as lines for a terminal."""
    _, sentence = verdict(results)
    rows = headlines(results)
    width = max((len(row.name) for row in rows), default=0)
    lines = [f"  {row.name:<{width}}  {row.value}{f'  ({row.note})' if row.note else ''}" for row in rows]
    return "\n".join([f"{results.title}: {sentence}", *lines])
