#!/usr/bin/env bash
# As near to a measured list as glint comes without making a signal: every outline is a line of
# scatterers 10 cm apart with phases of their own, which a transform's window gathers into peaks. A
# car ahead is speckle: in one scene stronger, in another weaker than its cross section; add --seed N
# to glint-traffic, or swap in glint-extract and compare.
set -o pipefail
glint-traffic cut-in \
  | glint-extract-contour --spacing-m 0.1 \
  | glint-ideal --sensors lrr77-coherent --sections account \
  | glint-sensor-smear \
  | glint-noise
