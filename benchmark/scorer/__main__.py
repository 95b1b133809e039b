"""`python -m railcrack_benchmark`."""

import sys

from railcrack_benchmark import main

sys.exit(main())
