"""The report: one JSON with everything, and one HTML page with its pictures inside."""

import base64
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape

from model.evaluation.intervals import Estimate
from model.evaluation.metrics import HEADLINES, METRICS
from model.evaluation.published import TABLES, Table
from model.evaluation.score import Protocol, Record
from model.evaluation.summary import Summary

SCHEMA = "artgen-evaluation/1"
RANKED_BY = "singapo.honest.nearest.rs_dgiou"
SHOWN = 8
"""Pictures of the best, and of the worst objects."""

STYLE = """
body{font:15px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:76rem;padding:0 1rem;color:#222}
h1{font-size:1.5rem}h2{font-size:1.15rem;margin:2.2rem 0 .4rem}code{font-size:.9em}
table{border-collapse:collapse;margin:.4rem 0}td,th{text-align:left;padding:.2rem .8rem .2rem 0;
vertical-align:top;border-bottom:1px solid #e4e6ea;font-variant-numeric:tabular-nums}
th{font-weight:600}.dim{color:#667}figure{margin:.8rem 0}figure img{max-width:100%;background:#fff}
figcaption{font-size:.88em}.wide{overflow-x:auto}svg text{font:11px system-ui}
@media (prefers-color-scheme:dark){body{background:#16181c;color:#dde}td,th{border-color:#333}
svg text{fill:#dde}.dim{color:#99a}}
"""


@dataclass(frozen=True, kw_only=True)
class Report:
    """All that a run found.

    Attributes:
        system: whose predictions they are.
        truth: where the truth came from.
        notes: what the reader must know.
        pictures: name of an object to the PNG of truth and prediction.
    """

    system: str
    truth: str
    protocol: Protocol
    records: Sequence[Record]
    summary: Summary
    notes: Sequence[str] = ()
    pictures: Mapping[str, bytes]

    def as_json(self) -> dict[str, object]:
        """Plain data for `evaluation.json`."""
        return {
            "schema": SCHEMA,
            "system": self.system,
            "truth": self.truth,
            "protocol": self.protocol,
            "notes": list(self.notes),
            "units": {name: metric.unit for name, metric in METRICS.items()},
            "summary": self.summary,
            "objects": sorted(self.records, key=lambda record: record.name),
        }


def page(report: Report) -> str:
    """The HTML document."""
    title = f"artgen evaluate: {escape(report.system)}"
    body = [f"<h1>{title}</h1>", *_head(report), *_overall(report.summary)]
    body += _groups("By category", report.summary.by_category)
    body += _groups("By number of parts", report.summary.by_parts)
    body += _matching(report.summary)
    body += _histograms(report.records)
    body += _published(report.summary)
    body += _gallery(report)
    body += _failures(report.summary)
    return (
        '<!doctype html><html lang="en"><meta charset="utf-8">'
        f'<title>{title}</title><meta http-equiv="Content-Security-Policy" content="default-src '
        f"'none'; img-src data:; style-src 'unsafe-inline'\"><style>{STYLE}</style>\n"
        + "\n".join(body)
        + "\n</html>\n"
    )


def _head(report: Report) -> Iterator[str]:
    own = report.protocol
    yield (
        f"<p>{report.summary.objects} objects of <code>{escape(report.truth)}</code>; "
        f"{len(report.summary.failures)} without a prediction. Those count with the worst value of "
        "every metric whose scale has an end, and are left out of the others: compare the column "
        "<i>objects</i>.</p>"
    )
    yield (
        f'<p class="dim">Placement: {own.align}. Surfaces: {own.points} points over the whole '
        f"object, the true one's longest side being 1; Particulate: {own.part_points}. Masks: "
        f"{own.mask_pixels} px, 4 views, 3 states. Radii: half diagonals of the true box at rest. "
        "Intervals: 95 %, bootstrap over objects.</p>"
    )
    for note in report.notes:
        yield f"<p><b>{escape(note)}</b></p>"


def _overall(summary: Summary) -> Iterator[str]:
    yield "<h2>All metrics</h2><div class=wide><table>"
    yield "<tr><th>metric<th>mean<th>95 %<th>median<th>unit<th>better<th>values<th>objects</tr>"
    for name, own in summary.overall.items():
        metric = METRICS[name]
        cells = (name, shown(own.mean), interval(own), shown(own.median), metric.unit)
        row = "".join(f"<td>{escape(cell)}" for cell in (*cells, metric.better))
        yield f"<tr>{row}<td>{own.values}<td>{own.objects}</tr>"
    yield "</table></div>"


def shown(value: float | None) -> str:
    """Four digits, or a dash where there is none."""
    return "–" if value is None else f"{value:.4g}"


def interval(own: Estimate) -> str:
    """`lower .. upper`, or nothing."""
    return "" if own.lower is None else f"{shown(own.lower)} .. {shown(own.upper)}"


def _groups(title: str, groups: Mapping[str, Mapping[str, Estimate]]) -> Iterator[str]:
    asked = [
        name for name in HEADLINES if any(own[name].mean is not None for own in groups.values())
    ]
    yield f"<h2>{title}</h2><div class=wide><table><tr><th>"
    yield "".join(f"<th>{escape(name.replace('.', ' '))}" for name in asked) + "</tr>"
    for group, own in groups.items():
        count = max(own[name].objects for name in asked) if asked else 0
        cells = "".join(
            f'<td>{shown(own[name].mean)}<br><span class="dim">{interval(own[name])}</span>'
            for name in asked
        )
        yield f'<tr><td>{escape(group)}<br><span class="dim">{count}</span>{cells}</tr>'
    yield "</table></div>"


def _matching(summary: Summary) -> Iterator[str]:
    yield "<h2>By order less by nearness</h2>"
    yield (
        "<p>Zero where every part stands in its true place of the order; the gap measures confused "
        "slots.</p><table><tr><th>metric<th>gap</tr>"
    )
    for name, gap in summary.gaps.items():
        yield f"<tr><td>{escape(name)}<td>{gap:+.4g}</tr>"
    yield "</table>"


def _histograms(records: Sequence[Record]) -> Iterator[str]:
    yield "<h2>Distributions over objects</h2>"
    for name in HEADLINES:
        values = [float(v) for record in records for v in record.metrics.get(name, ())]
        if len(set(values)) > 1:
            yield histogram(values, name)


def histogram(values: Sequence[float], title: str, bins: int = 24) -> str:
    """An SVG of counts over equal bins."""
    low, high = min(values), max(values)
    counts = [0] * bins
    for value in values:
        counts[min(int((value - low) / (high - low) * bins), bins - 1)] += 1
    top = max(counts)
    bars = "".join(
        f'<rect x="{8 + 10 * k}" y="{84 - 60 * count / top:.1f}" width="9" '
        f'height="{60 * count / top:.1f}" fill="#4a7bd0"/>'
        for k, count in enumerate(counts)
    )
    return (
        f'<svg width="270" height="106" role="img"><text x="8" y="14">{escape(title)}</text>{bars}'
        f'<text x="8" y="98">{low:.3g}</text><text x="218" y="98">{high:.3g}</text></svg>'
    )


def _published(summary: Summary) -> Iterator[str]:
    yield "<h2>Beside published tables</h2>"
    yield (
        '<p class="dim">Other objects and partly other protocols: these rows say where the field '
        "stands.</p>"
    )
    for table in TABLES:
        yield f"<h3>{escape(table.title)}</h3><p class=dim>{escape(table.told)}</p><table>"
        names = list(table.rows[0].numbers)
        yield "<tr><th>system" + "".join(f"<th>{escape(name)}" for name in names) + "</tr>"
        for row in table.rows:
            cells = "".join(f"<td>{number:g}" for number in row.numbers.values())
            yield f"<tr><td>{escape(row.system)} (paper){cells}</tr>"
        yield _ours(table, names, summary)
        yield "</table>"


def _ours(table: Table, names: Sequence[str], summary: Summary) -> str:
    cells = []
    for name in names:
        own = table.ours[name]
        mean = summary.overall[own].mean
        cells.append(f'<td>{shown(mean)}<br><span class="dim">{escape(own)}</span>')
    return "<tr><td><b>this run</b>" + "".join(cells) + "</tr>"


def _gallery(report: Report) -> Iterator[str]:
    ranked = ranking(report.records)
    yield f"<h2>Pictures, by {RANKED_BY}</h2>"
    yield (
        "<p>From left: truth at rest, truth open, prediction at rest, prediction open. A line with "
        "a dot is an axis and where it points.</p>"
    )
    for title, own in (("Best", ranked[:SHOWN]), ("Worst", ranked[SHOWN:][::-1][:SHOWN])):
        drawn = [record for record in own if record.name in report.pictures]
        if drawn:
            yield f"<h3>{title}</h3>"
        for record in drawn:
            yield _figure(record, report.pictures[record.name])


def ranking(records: Sequence[Record]) -> list[Record]:
    """Objects with a prediction, best first."""
    scored = [record for record in records if RANKED_BY in record.metrics if not record.failure]
    return sorted(scored, key=lambda record: (record.metrics[RANKED_BY][0], record.name))


def _figure(record: Record, png: bytes) -> str:
    data = base64.b64encode(png).decode()
    told = ", ".join(
        f"{name.split('.')[-1]} {shown(record.metrics[name][0])}"
        for name in (RANKED_BY, "singapo.honest.nearest.rs_dcdist", "masks.nearest.composite")
        if name in record.metrics
    )
    gates = "; ".join(f"{gate}: {why}" for gate, why in record.reasons.items())
    parts = f"{record.predicted_parts} of {record.parts} parts"
    return (
        f'<figure><img src="data:image/png;base64,{data}" alt="{escape(record.name)}">'
        f"<figcaption><b>{escape(record.name)}</b> {parts}, {told}"
        f'<br><span class="dim">{escape(gates)}</span></figcaption></figure>'
    )


def _failures(summary: Summary) -> Iterator[str]:
    if summary.failures:
        yield "<h2>Without a prediction</h2><table>"
        for name, why in sorted(summary.failures.items()):
            yield f"<tr><td>{escape(name)}<td>{escape(why)}</tr>"
        yield "</table>"
