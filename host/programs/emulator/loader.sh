#!/bin/sh
# Stands in for teensy_loader_cli if the robot is one of astrolabe-emulator: takes the same arguments, waits for the boot
# loader and hands it the image. For `astrolabe flash`, with --pty PATH of the emulator:
#   ASTROLABE_LOADER=.../astrolabe-emulated-loader ASTROLABE_EMULATOR=PATH astrolabe flash --port PATH
set -eu
: "${ASTROLABE_EMULATOR:?set it to the path that astrolabe-emulator has for --pty}"
for image; do :; done # the last argument
tries=200             # one each tenth of a second
while [ ! -p "$ASTROLABE_EMULATOR.halfkay" ]; do
  tries=$((tries - 1))
  [ $tries -gt 0 ] || { echo "no emulated Teensy is in its boot loader" >&2; exit 1; }
  sleep 0.1
done
cat "$image" >"$ASTROLABE_EMULATOR.halfkay"
