"""`python -m checker.cli` is `subt-check`."""

import sys

from checker.cli import main

sys.exit(main())
