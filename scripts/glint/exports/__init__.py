"""Layouts of other data sets, which scripts/export writes."""
