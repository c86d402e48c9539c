#!/usr/bin/env bash
# The roadside of a motorway. In the viewer, coloured by path, the posts of guardrails, sign posts and
# bushes pass by: what a scan lists comes again in the next ones, under the same number. The cars and
# the truck hide what stands behind them. With --effects=-roadside for glint-ideal only the vehicles
# are left, and false alarms.
set -o pipefail
glint-traffic motorway \
  | glint-extract \
  | glint-ideal --sensors lrr77-full --sections account \
  | glint-sensor \
  | glint-noise
