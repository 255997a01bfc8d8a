"""What goes wrong with data."""


class DataError(ValueError):
    """A file is damaged, lacks something, or cannot hold what is written; the text names file and group."""
