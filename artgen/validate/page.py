"""One HTML page with everything inside: verdicts, findings, pictures of the worst poses, plots."""

import base64
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from html import escape

from artgen.validate.batch import Judgement
from artgen.validate.pictures import Picture
from artgen.validate.report import Finding, Report

MOST_PICTURES = 200
"""Some 20 kB each; a page beyond a few megabytes opens slowly."""

STYLE = """
body{font:15px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:70rem;padding:0 1rem;color:#222}
h1{font-size:1.5rem}h2{font-size:1.1rem;margin:2rem 0 .3rem}code{font-size:.9em}
table{border-collapse:collapse;width:100%}td,th{text-align:left;padding:.25rem .6rem .25rem 0;
vertical-align:top;border-bottom:1px solid #e4e6ea}.bad{color:#b3261e}.good{color:#1b7340}
.dim{color:#667}figure{display:inline-block;margin:.6rem 1rem .6rem 0;vertical-align:top}
figcaption{max-width:360px;font-size:.85em}summary{cursor:pointer}svg text{font:12px system-ui}
@media (prefers-color-scheme:dark){body{background:#16181c;color:#dde}td,th{border-color:#333}
svg text{fill:#dde}.bad{color:#f2867e}.good{color:#6fcf97}}
"""


def page(judgements: Sequence[tuple[str, Judgement]]) -> str:
    """The document; each judgement comes with the words that name its asset."""
    bad = [(name, j) for name, j in judgements if not j.report.ok]
    head = f"{len(judgements) - len(bad)} of {len(judgements)} assets are valid"
    body = [f"<h1>artgen validate: {head}</h1>", *_plots([j.report for _, j in judgements])]
    left = MOST_PICTURES
    for name, judgement in bad:
        body += _asset(name, judgement, left)
        left -= len(judgement.pictures[:left])
    body += _valid([(name, j.report) for name, j in judgements if j.report.ok])
    return (
        '<!doctype html><html lang="en"><meta charset="utf-8"><title>artgen validate</title>'
        f'<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; '
        f"img-src data:; style-src 'unsafe-inline'\"><style>{STYLE}</style>\n"
        + "\n".join(body)
        + "</html>\n"
    )


def _plots(reports: Sequence[Report]) -> Iterator[str]:
    found = Counter(check for r in reports for check in {f.check for f in r.findings})
    if found:
        yield "<h2>Assets by check that found something</h2>"
        yield bars({name: float(count) for name, count in found.most_common(25)}, "{:.0f}")
    spent: Counter[str] = Counter()
    for report in reports:
        spent.update(report.seconds)
    timed = sum(bool(report.seconds) for report in reports)
    if timed:
        yield "<h2>CPU milliseconds an asset, by level</h2>"
        yield bars({name: 1e3 * spent[name] / timed for name in sorted(spent)}, "{:.1f}")


def bars(values: Mapping[str, float], shown: str) -> str:
    """An SVG of horizontal bars, one a name."""
    most = max(values.values()) or 1.0
    rows = []
    for row, (name, value) in enumerate(values.items()):
        y, width = 22 * row, 420.0 * value / most
        rows.append(
            f'<text x="0" y="{y + 15}">{escape(name)}</text>'
            f'<rect x="190" y="{y + 4}" width="{width:.1f}" height="14" fill="#4a7bd0"/>'
            f'<text x="{196 + width:.1f}" y="{y + 15}">{shown.format(value)}</text>'
        )
    return f'<svg width="680" height="{22 * len(values)}" role="img">{"".join(rows)}</svg>'


def curve(points: Sequence[tuple[float, float]], title: str) -> str:
    """An SVG line over q."""
    qs, values = zip(*points, strict=True)
    span, top = (max(qs) - min(qs)) or 1.0, max(values) or 1.0
    line = " ".join(
        f"{40 + 300 * (q - min(qs)) / span:.1f},{100 - 80 * value / top:.1f}" for q, value in points
    )
    return (
        '<svg width="360" height="130" role="img">'
        f'<text x="40" y="12">{escape(title)}, at most {top:.3g}</text>'
        '<path d="M40 20V100H340" fill="none" stroke="#888"/>'
        f'<polyline points="{line}" fill="none" stroke="#d0602a" stroke-width="2"/>'
        f'<text x="40" y="118">{min(qs):.3g}</text>'
        f'<text x="310" y="118">{max(qs):.3g}</text></svg>'
    )


def _asset(name: str, judgement: Judgement, left: int) -> Iterator[str]:
    report = judgement.report
    yield f'<h2><span class="bad">invalid</span> {escape(report.asset)}</h2>'
    yield f'<p class="dim"><code>{escape(name)}</code>, {escape(report.format)}</p>'
    yield "<table><tr><th>check<th>part<th>found<th>expected<th>cause and remedy</tr>"
    yield from (_row(finding) for finding in report.findings)
    yield "</table>"
    for picture in judgement.pictures[: max(left, 0)]:
        yield _figure(picture, report.findings[picture.number])
    yield from _simulated(report)
    yield from _skipped(report)


def _row(finding: Finding) -> str:
    shown = f"{finding.value:.6g}" if isinstance(finding.value, float) else finding.value
    cells = (finding.check, finding.part, shown, finding.bound)
    words = f"{finding.cause}; {finding.remedy}"
    return f"<tr>{''.join(f'<td>{escape(cell)}' for cell in (*cells, words))}</tr>"


def _figure(picture: Picture, finding: Finding) -> str:
    data = base64.b64encode(picture.png).decode()
    plot = curve(picture.curve, picture.unit) if picture.curve else ""
    return (
        f'<figure><img src="data:image/png;base64,{data}" alt="{escape(finding.part)}">'
        f"<figcaption>{escape(finding.check)}: {escape(finding.cause)}</figcaption>{plot}</figure>"
    )


def _skipped(report: Report) -> Iterator[str]:
    reasons: dict[str, list[str]] = {}
    for skipped in report.skipped:
        reasons.setdefault(skipped.reason, []).append(skipped.name)
    if reasons:
        rows = (
            f"<tr><td>{escape(', '.join(names))}<td>{escape(reason)}</tr>"
            for reason, names in reasons.items()
        )
        yield f"<details><summary>not checked</summary><table>{''.join(rows)}</table></details>"


def _simulated(report: Report) -> Iterator[str]:
    """Which effects each check had computed, and why."""
    for item in report.simulated:
        rows = (
            f"<tr><td>{escape(effect)}<td>{escape(why)}</tr>"
            for effect, why in item.effects.items()
        )
        yield f"<details><summary>{escape(item.check)}: what was simulated</summary>"
        yield f"<table>{''.join(rows)}</table></details>"


def _valid(reports: Sequence[tuple[str, Report]]) -> Iterator[str]:
    if reports:
        rows = (
            f'<tr><td class="good">valid<td>{escape(report.asset)}<td>{len(report.judged)} checks'
            f'<td class="dim"><code>{escape(name)}</code></tr>'
            for name, report in reports
        )
        yield f"<h2>Valid</h2><table>{''.join(rows)}</table>"
