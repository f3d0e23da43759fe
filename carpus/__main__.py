"""`python -m carpus`."""

import sys

from carpus.app.__main__ import main

sys.exit(main())
