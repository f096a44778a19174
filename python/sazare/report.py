"""The report of a run: one HTML page that holds its pictures, and the pictures as files."""

import base64
from pathlib import Path

import jinja2

from sazare import style, view3d
from sazare.folders import own
from sazare.methods import method_of
from sazare.results import open_run
from sazare.summary import headlines, verdict
from sazare.tables import write_table

MOST_FRAGMENTS = 10


def _drawn(section, folder):
    """The section as the template wants it, its picture written and embedded; without data, its heading and what it says instead."""
    figure = section.draw()
    if figure is None:
        return {"heading": section.heading, "missing": section.missing, "image": None}
    path = folder / f"{section.name}.png"
    style.save(figure, path)
    image = base64.b64encode(path.read_bytes()).decode()
    return {"name": section.name, "heading": section.heading, "caption": section.caption, "wide": section.wide, "image": image}


def _facts(results):
    """Small print about the run: (name, value)."""
    manifest, figures = results.manifest, results.figures
    machine = manifest.get("machine", {})
    rows = [
        ("method", manifest.get("method")),
        ("sazare", f"{manifest['sazare']} ({manifest.get('commit', 'unknown')})" if "sazare" in manifest else None),
        ("started", manifest.get("started")),
        ("finished", manifest.get("finished")),
        ("processor", machine.get("cpu")),
        ("cores, threads", f"{machine.get('cores')}, {machine.get('threads')}" if "cores" in machine else None),
        ("steps", style.count(figures["steps"]) if "steps" in figures else None),
        ("smallest step", style.quantity(figures["smallest_step"], "s") if "smallest_step" in figures else None),
        ("pair evaluations", style.count(figures["pair_evaluations"]) if "pair_evaluations" in figures else None),
        ("state hash", results.state_hash),
    ]
    return [(name, value) for name, value in rows if value]


def _largest_fragments(results):
    """Rows of the table of fragments."""
    table = results.fragments
    return [
        {
            "number": int(table["fragment"][number]),
            "elements": style.count(table["elements"][number]),
            "volume": f"{table['volume'][number]:.3g}",
            "mass": f"{table['mass'][number]:.4g}",
            "size": style.quantity(table["size"][number], "m"),
            "throw": style.quantity(table["throw"][number], "m"),
        }
        for number in range(min(MOST_FRAGMENTS, table.rows))
    ]


def _page(results, sections):
    view = view3d.packed_view(results)
    sheets = method_of(results).sheets(results)
    gauges = [] if any(sheet.name == "peak_velocities" for sheet in sheets) else results.gauges.values()
    loader = jinja2.FileSystemLoader(Path(__file__).with_name("templates"))
    template = jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True).get_template("report.html")
    tone, sentence = verdict(results)
    return template.render(
        title=results.title,
        tone=tone,
        sentence=sentence,
        headlines=headlines(results),
        sections=[section for section in sections if section["image"]],
        without_data=[section for section in sections if not section["image"] and section["missing"]],
        facts=_facts(results),
        fragments=_largest_fragments(results),
        gauges=[(gauge.name, style.quantity(gauge.ppv, "m/s")) for gauge in gauges],
        sheets=sheets,
        case_text=results.case_text,
        has_case=method_of(results).has_case,
        view=view,
        viewer=view3d.viewer_script() if view else "",
    )


def sections_of(results):
    """The pictures that suit a run's method (list of Section)."""
    return method_of(results).sections(results)


def write_pictures(path, names, folder):
    """Writes the named pictures of a run's report as PNG into a folder; yields their paths. Without names, yields a line for each
    picture there is. Raises NotARun where `path` is no run or a picture would be written through a link, ValueError for a picture
    that there is not or that has no data."""
    sections = {section.name: section for section in sections_of(open_run(path))}
    if not names:
        width = max(map(len, sections), default=0) + 2
        yield from (f"{name:<{width}}{section.heading}: {section.caption}" for name, section in sections.items())
        return
    unknown = [name for name in names if name not in sections]
    if unknown:
        raise ValueError(f"no picture {', '.join(unknown)}; there are: {', '.join(sections)}")
    Path(folder).mkdir(parents=True, exist_ok=True)
    for name in names:
        figure = sections[name].draw()
        if figure is None:
            raise ValueError(f"no picture {name} of this run: {sections[name].missing}")
        target = own(Path(folder) / f"{name}.png")
        style.save(figure, target)
        yield target


def write_report(path):
    """Writes DIR/report.html, the pictures in DIR/report/ and the method's tables beside them; returns the page's path.

    Raises NotARun where DIR is no run, or where it has links in the places of the report.
    """
    results = open_run(path)
    folder, page = own(results.path / "report"), own(results.path / "report.html")
    folder.mkdir(exist_ok=True)
    for old in folder.glob("*.png"):
        old.unlink()
    sections = [_drawn(section, folder) for section in sections_of(results)]
    for name, columns in method_of(results).tables(results).items():
        target = own(results.path / name)
        if columns:
            write_table(target, columns)
    page.write_text(_page(results, sections), encoding="utf-8")
    return page
