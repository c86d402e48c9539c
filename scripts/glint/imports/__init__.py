"""Boxes of other data sets as traffic, which scripts/import makes."""
