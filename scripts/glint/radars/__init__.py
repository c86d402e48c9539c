"""A radar's suite from the figures of its data sheet, for scripts/make-radar."""
