"""Labelled data sets, for scripts/dataset and scripts/check-set."""
