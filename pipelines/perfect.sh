#!/usr/bin/env bash
# The same cut-in as a textbook sensor would see it: every visible reflection centre is a target of
# its own, with independent Gaussian noise. Swap the two alternatives for glint-sensor and
# glint-noise to see what the paper's model changes.
set -o pipefail
glint-traffic cut-in \
  | glint-extract \
  | glint-ideal --sensors corner77 --sections account \
  | glint-sensor-perfect \
  | glint-noise-gauss
