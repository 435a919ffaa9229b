"""`python -m fabricate` is the same as the command `fabricate`."""

from fabricate.cli import main

if __name__ == "__main__":
    main()
