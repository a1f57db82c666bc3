"""The command `nearwall`: `python -m nearwall`, and the script that pip installs."""

import signal
import sys

from .wheel import compiled


def main() -> None:
    """Runs the command with the arguments of this process and ends with its status."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it at once
    sys.exit(compiled().command(["nearwall", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
