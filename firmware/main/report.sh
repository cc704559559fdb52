#!/usr/bin/env bash
# firmware/main/report.sh IMAGE: what an image takes on the chip, and where its files are.
set -euo pipefail
image=$1

sizes() { arm-none-eabi-size -A -d "$image.elf" | awk '$1 ~ /^\./ && $1 !~ /debug|ARM/ && $2 > 0'; }

echo
printf '%-24s %8s  %s\n' section bytes where
sizes | awk '{
  place = $3 >= 1610612736 ? "flash" : $3 >= 536870912 ? "RAM" : "code RAM, copied from flash"
  printf "%-24s %8d  0x%08x  %s\n", $1, $2, $3, place }'
echo
sizes | awk '
  $3 >= 536870912 && $3 < 553648128 { if ($3 + $2 - 536870912 > ram) ram = $3 + $2 - 536870912 }
  END { printf "RAM   %6d of 16384 bytes, stack included\n", ram }'
arm-none-eabi-nm "$image.elf" | awk '$3 == "image_length" { printf "%s\n", $1 }' |
  while read -r length; do printf 'flash %6d of 65536 bytes\n' "0x$length"; done
echo
echo "largest parts of RAM"
arm-none-eabi-nm -CS --size-sort -r "$image.elf" | awk '$1 ~ /^2/ && shown++ < 6 { bytes = $2; $1 = $2 = $3 = ""; print bytes, $0 }' |
  while read -r bytes name; do printf '%8d  %s\n' "0x$bytes" "$name"; done
echo
echo "flash with   astrolabe flash $image.hex"
echo "more in      $image.map"
