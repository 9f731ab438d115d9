"""``python -m contact_oracle`` is the command contact-oracle that came with the package."""
import os
import sys

from .by_command import command
from .errors import InputError

if __name__ == "__main__":
    try:
        path = command()
    except InputError as error:
        sys.exit(f"contact_oracle: {error}")
    os.execv(path, [path, *sys.argv[1:]])
