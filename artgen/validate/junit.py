"""JUnit XML: a suite for each asset, a case for each check, as CI servers read it."""

import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence

from artgen.validate.report import Report

COUNTED = ("tests", "failures", "skipped")
NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd]")
"""Characters that XML 1.0 has no way to write."""


def junit_xml(reports: Mapping[str, Report]) -> bytes:
    """The document; names of suites are the keys."""
    root = ET.Element("testsuites")
    counts = [_add_suite(root, name, report) for name, report in reports.items()]
    for place, key in enumerate(COUNTED):
        root.set(key, str(sum(own[place] for own in counts)))
    ET.indent(root)
    return bytes(ET.tostring(root, encoding="utf-8", xml_declaration=True)) + b"\n"


def _add_suite(root: ET.Element, name: str, report: Report) -> Sequence[int]:
    suite = ET.SubElement(root, "testsuite", name=_clean(name), errors="0")
    found: dict[str, list[str]] = {check: [] for check in report.judged}
    for finding in report.findings:
        found.setdefault(finding.check, []).append(str(finding))
    for check, lines in sorted(found.items()):
        case = _case(suite, name, check)
        if lines:
            failure = ET.SubElement(case, "failure", message=_clean(lines[0]), type=check)
            failure.text = _clean("\n".join(lines))
    notes: dict[str, list[str]] = {}
    for skipped in report.skipped:
        if skipped.name not in found:
            notes.setdefault(skipped.name, []).append(skipped.reason)
    for check, reasons in sorted(notes.items()):
        ET.SubElement(_case(suite, name, check), "skipped", message=_clean("; ".join(reasons)))
    counts = (len(found) + len(notes), sum(map(bool, found.values())), len(notes))
    for key, count in zip(COUNTED, counts, strict=True):
        suite.set(key, str(count))
    suite.set("time", f"{sum(report.seconds.values()):.3f}")
    return counts


def _case(suite: ET.Element, asset: str, check: str) -> ET.Element:
    level, _, rest = check.partition(".")
    return ET.SubElement(
        suite, "testcase", classname=_clean(f"{asset}.{level}"), name=rest or check, time="0"
    )


def _clean(text: str) -> str:
    return NOT_XML.sub("?", text)
