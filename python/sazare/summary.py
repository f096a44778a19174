"""A run's headline figures in words: for the top of the report and for the terminal."""

from dataclasses import dataclass

from sazare.style import count, quantity

# A ledger closed better than the first counts as good, worse than the second as bad; shares of the work done.
GOOD_BALANCE, BAD_BALANCE = 1e-4, 1e-2


@dataclass(frozen=True)
class Headline:
    """One figure: its name, its value in words, and a smaller line below it."""

    name: str
    value: str
    note: str = ""


def energy_balance(figures):
    """What the ledger does not account for, as a share of the work done; None where it cannot be said."""
    work, residual = figures.get("energy_work"), figures.get("energy_residual")
    return abs(residual / work) if work and residual is not None else None


def verdict(results):
    """("good", "fair" or "bad", sentence) about the run as a whole."""
    status = results.manifest.get("status")
    balance = energy_balance(results.figures)
    if status is None:
        return "fair", "The run has not written its manifest: it is still going, or was cut off."
    if status == "running":
        return "fair", "The run is still going, or was cut off. What follows is as far as it came."
    if status != "done":
        return "bad", f"The run ended early; its status is “{status}”. What follows is as far as it came."
    if results.manifest.get("method") == "mps":
        share = _share_of_limit(results.figures)
        return "good", "The run is done." + (f" Its step is {share:.2f} of the predicted limit." if share else "")
    if results.manifest.get("method") == "spheres" and balance is not None:
        return "good" if balance <= BAD_BALANCE else "fair", f"The run is done. The energy ledger closes within {balance:.1e} of the work done."
    if results.manifest.get("method") == "fem" and balance is not None:
        return "good" if balance <= BAD_BALANCE else "fair", f"The run is done. The energy ledger closes within {balance:.1e} of the work done."
    if results.manifest.get("method") == "hybrid":
        made, work = results.figures.get("energy_made", 0.0), results.figures.get("work_on_nodes", 0.0)
        share = f" The surface made {made / abs(work):.1e} of the work that went over it." if work else ""
        return "good", "The run is done." + share
    if results.manifest.get("method") == "study":
        largest = results.figures.get("largest_log_difference", 0.0)
        return "good", f"The study is done. Prediction and bisection differ by at most {100 * largest:.2f} %."
    if balance is None:
        return "fair", "The run is done. Its energy balance is not known."
    words = f"The run is done. The energy ledger closes within {balance:.1e} of the work done."
    if balance <= GOOD_BALANCE:
        return "good", words
    if balance <= BAD_BALANCE:
        return "fair", f"{words} Below {GOOD_BALANCE:.0e} would be good: consider a smaller stability_fraction."
    return "bad", f"{words} That is too much for the results to be trusted: use a smaller stability_fraction."


def headlines(results):
    """The figures for the top of the report; those the run did not write are left out."""
    figures = results.figures
    balance = energy_balance(figures)
    rows = [
        ("broken_joints", "joints broken", count, _share(figures, "broken_joints", "joints")),
        ("bodies_broken", "bodies broken", count, _share(figures, "bodies_broken", "bodies")),
        ("fragments", "fragments", count, _of(figures, "elements", "elements")),
        ("x50", "X50", lambda x: quantity(x, "m"), _note(figures, "x80", "X80 ", "m")),
        ("throw_max", "largest throw", lambda x: quantity(x, "m"), ""),
        ("peak_speed", "peak speed", lambda x: quantity(x, "m/s"), ""),
        ("energy_work", "work of the loads", lambda x: quantity(x, "J"), ""),
        ("particles", "particles", count, ""),
        ("broken_springs", "springs broken", count, _of(figures, "elements", "elements")),
        ("open_links", "faces open", count, ""),
        ("contacts", "contacts at the end", count, ""),
        ("links_broken", "links broken", count, ""),
        ("final_displacement", "displacement at the end", lambda x: quantity(x, "m"), ""),
        ("peak_acceleration", "peak acceleration", lambda x: quantity(x, "m/s²"), ""),
        ("peak_displacement", "peak displacement", lambda x: quantity(x, "m"), ""),
        ("step", "step", lambda x: quantity(x, "s"), _step_note(figures)),
        ("freedoms", "degrees of freedom", count, _of(figures, "nodes", "nodes")),
        ("windows", "windows", count, _of(figures, "passes", "passes")),
        ("peak_force", "peak force on the surface", lambda x: quantity(x, "N"), ""),
        ("iterations", "iterations", count, _of(figures, "steps", "steps")),
        ("cases", "cases", count, _of(figures, "cases_done", "done")),
    ]
    found = [Headline(name, words(figures[key]), note) for key, name, words, note in rows if figures.get(key) is not None]
    if balance is not None:
        found.append(Headline("energy balance", f"{balance:.1e}", "residual / work"))
    if figures.get("wall_seconds") is not None:
        found.append(Headline("wall time", quantity(figures["wall_seconds"], "s"), _machine(results.manifest)))
    return found


def _share_of_limit(figures):
    limit = figures.get("predicted_limit")
    return figures["step"] / limit if limit and figures.get("step") else None


def _step_note(figures):
    limit = _note(figures, "predicted_limit", "limit ", "s")
    if "levels" not in figures:
        return limit
    return f"{figures['levels']} levels, smallest {quantity(figures['smallest_step'], 's')}, {limit}"


def _share(figures, part, whole):
    if not figures.get(whole) or figures.get(part) is None:
        return ""
    return f"of {count(figures[whole])}, {figures[part] / figures[whole]:.0%}"


def _of(figures, key, words):
    return f"{count(figures[key])} {words}" if figures.get(key) is not None else ""


def _note(figures, key, before, unit):
    return f"{before}{quantity(figures[key], unit)}" if figures.get(key) is not None else ""


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
