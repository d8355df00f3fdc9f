"""The report names what the user said in vain."""

from artgen.ingest.options import GivenRest
from artgen.ingest.report import report, table
from artgen.ingest.task import Outcome

READ = Outcome(
    asset_id="pm_100809",
    source="data/100809",
    status="valid",
    said={
        "source": {"id": "100809"},
        "joints_read": {
            "door_joint": {"number": "1", "confidence": "given"},
            "drawer_joint": {"number": "0", "confidence": "high"},
        },
    },
)
REFUSED = Outcome(asset_id="pm_7", source="data/7", status="refused", message="no mesh")


def test_entries_of_the_table_of_rests_that_fit_nothing_are_told() -> None:
    """An entry under the annotation's number, of nobody, or of a node that does not move was passed
    over in silence. Of an object that could not be read, nobody can say."""
    rests = [
        GivenRest(id=id, number=number, q=0.0)
        for id, number in (("100809", "1"), ("100809", "9"), ("809", "1"), ("nobody", "1"),
                           ("7", "3"))
    ]  # fmt: skip
    expected = [
        "100809, 9: no joint with stops is numbered so",
        "809: no object of this run is called so",
        "nobody: no object of this run is called so",
    ]
    assert report([READ, REFUSED], rests)["rests_unused"] == expected
    lines = table([READ, REFUSED], rests).splitlines()
    assert lines[-3:] == [f"--rest entry not used  {line}" for line in expected]
    assert report([READ], rests[:1])["rests_unused"] == []


def test_a_refusal_is_told_to_its_end_and_with_its_place() -> None:
    """It was cut at 110 letters, in the file as well, before it said what had been expected."""
    message = f"{'a part without a mesh, ' * 8}what was expected; what to do"
    refused = Outcome(asset_id="pm_7", source="data/7", status="refused", message=message)
    assert f"data/7: {message}" in table([refused])


def test_findings_on_a_bundle_are_cut_where_its_report_has_them() -> None:
    message = f"joint.rest: {'a door is not quite closed, ' * 8}"
    flawed = Outcome(asset_id="pm_8", source="data/8", status="flawed", message=message)
    (line,) = (line for line in table([flawed]).splitlines() if "pm_8" in line)
    assert line.endswith("... (all of it: report.json)")
