"""The programs as a command: python3 -m seamflow smooth scan.ply smooth.ply"""

import sys

from . import __version__, _core


def main():
    words = sys.argv[1:]
    if words == ["--version"]:
        print(f"seamflow {__version__}\n{_core.about_licence}")
        return 0
    if not words or words[0] not in _core.programs:
        print(f"usage: python3 -m seamflow {'|'.join(_core.programs)} ...; each of them knows --help\n"
              "       python3 -m seamflow --version", file=sys.stderr)
        return 2
    return _core.run_program(words)


if __name__ == "__main__":
    sys.exit(main())
