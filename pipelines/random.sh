#!/usr/bin/env bash
# Random snapshots of medium traffic for a large labelled set. Every frame is drawn by its number
# alone: --first and --frames cut the set anywhere, and the pieces joined are the same bytes.
set -o pipefail
glint-traffic-random --density medium --frames 200 \
  | glint-extract \
  | glint-ideal --sensors corner77 --sections account \
  | glint-sensor \
  | glint-noise
