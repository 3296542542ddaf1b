"""``python -m tmm_gen``: the same as the ``tmm-gen`` script."""

import sys

from tmm_gen.cli import main

if __name__ == "__main__":
    sys.exit(main())
