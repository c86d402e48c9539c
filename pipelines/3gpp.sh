#!/usr/bin/env bash
# The cut-in with the cars of 3GPP TR 38.901: five scattering points each, with lobes in azimuth and
# elevation over a floor that is seen from everywhere; trucks are those of their documents. Swap in
# glint-extract and cars make a third of the targets: its points are weaker, and none is seen from
# behind.
set -o pipefail
glint-traffic cut-in \
  | glint-extract-3gpp \
  | glint-ideal --sensors lrr77-full --sections account \
  | glint-sensor \
  | glint-noise
