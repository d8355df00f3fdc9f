"""Blender's handling of its arguments, as measured on Blender 3.4.1, for tests without a Blender.

Arguments act in their order. A script that raises leaves the exit code at 0 unless
`--python-exit-code N` came before `-P`; `sys.exit` is obeyed; what follows `--` is left alone; `-f`
renders whatever is loaded, here by saying so.
"""

import runpy
import sys
import traceback


def main(argv: list[str]) -> int:
    """Exit code."""
    own = argv[: argv.index("--")] if "--" in argv else argv
    words, raised = iter(own[1:]), 0
    for word in words:
        if word == "--python-exit-code":
            raised = int(next(words))
        elif word in ("-s", "-e"):
            next(words)
        elif word == "-f":
            print(f"Blender itself renders {next(words)}")  # noqa: T201
        elif word == "-P":
            try:
                runpy.run_path(next(words), run_name="__main__")
            except Exception:
                traceback.print_exc()
                if raised:
                    return raised
        elif word not in ("-b", "--factory-startup"):
            print(f"cannot read file {word}", file=sys.stderr)  # noqa: T201
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
