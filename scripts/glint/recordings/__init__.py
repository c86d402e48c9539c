"""Recordings of real radars beside simulated ones, for scripts/realism."""
