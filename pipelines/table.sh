#!/usr/bin/env bash
# Targets as a CSV table for a spreadsheet: side crossing, noise-free.
set -o pipefail
glint-traffic side-crossing \
  | glint-extract \
  | glint-ideal --sensors srr24-pair \
  | glint-sensor \
  | glint-noise-none \
  | glint-export-csv
