#!/usr/bin/env bash
# A radar of another kind comes towards the ego: in the viewer the van is lost below the threshold while the
# second oncoming car is near (7.6 to 8.3 s), as the noise and the threshold with it rise by up to 17 dB. With
# --effects=-rain,-fog,-interference it never is.
set -o pipefail
glint-traffic wet-road \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
      --effects=-rain,-fog \
  | glint-sensor \
  | glint-noise
