"""A report of a fit: one page of HTML without scripts or files beside it."""
