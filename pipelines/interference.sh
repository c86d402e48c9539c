#!/usr/bin/env bash
# A radar of another kind comes towards the ego: in the viewer the van is a target in 17 scans and else lost
# below the threshold, as the noise and the threshold with it rise by up to 17 dB. With
# --effects=-rain,-fog,-interference it is one in 89 scans, from 4.5 to 9 s, while its level is high.
set -o pipefail
glint-traffic wet-road \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
      --effects=-rain,-fog \
  | glint-sensor \
  | glint-noise
