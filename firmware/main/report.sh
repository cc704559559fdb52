#!/usr/bin/env bash
# firmware/main/report.sh BOARD: what the image of a board takes on the chip, what takes it, and where its files are.
set -euo pipefail
board=$1
image=build/$board/bin/astrolabe-$board
case $board in
  teensy40) flash_budget=98304 ram_budget=24576 flashed=hex ;;
  rp2040) flash_budget=98304 ram_budget=98304 flashed=uf2 ;; # the code is in its RAM, too
  *) echo "report.sh: no budgets for the board '$board'" >&2; exit 2 ;;
esac

sections() { arm-none-eabi-size -A -d "$image.elf" | awk '$1 ~ /^\./ && $1 !~ /debug|ARM/ && $2 > 0'; }
symbols() { arm-none-eabi-nm -S "$@" "$image.elf" | awk '$2 ~ /^[0-9a-f]+$/ && length($2) == 8'; }
decimal() { while read -r bytes name; do printf '%8d  %s\n' "0x$bytes" "$name"; done; }

# largest TITLE KINDS: the largest objects whose kind in `nm` is one of KINDS.
largest() {
  echo
  echo "$1"
  symbols -C --size-sort -r | awk -v kinds="$2" 'index(kinds, $3) && shown++ < 6 {
    bytes = $2; $1 = $2 = $3 = ""; print bytes, $0 }' | decimal
}

flash=$((16#$(arm-none-eabi-nm "$image.elf" | awk '$3 == "image_length" { print $1 }')))
ram=$(sections | awk '$3 >= 536870912 && $3 < 553648128 { end = $3 + $2 - 536870912; if (end > ram) ram = end }
  END { print ram + 0 }')
printf '\nflash %6d of %d bytes\nRAM   %6d of %d bytes, stack included\n\n' \
  "$flash" "$flash_budget" "$ram" "$ram_budget"

printf '%8s  %-22s %-10s\n' bytes section where
sections | awk '{
  at_flash = $3 >= 1610612736 || ($3 >= 268435456 && $3 < 536870912)
  place = at_flash ? "flash" : $3 >= 536870912 ? "RAM" : "code RAM, copied from flash"
  printf "%8d  %-22s 0x%08x  %s\n", $2, $1, $3, place }'

echo
echo "code by module; what is inlined counts where it ends up"
symbols -l | awk -F'\t' '
  split($1, word, " ") == 4 && word[3] ~ /[tTwW]/ {
    module = match($2, /(common|hal|firmware|tests)\/.*\//) ? substr($2, RSTART, RLENGTH - 1) : "libraries"
    print module, word[2] }' |
  while read -r module bytes; do echo "$module $((16#$bytes))"; done |
  awk '{ sum[$1] += $2 } END { for (module in sum) printf "%8d  %s\n", sum[module], module }' | sort -rn
largest "largest constants" rR
largest "largest objects in RAM" bBdD

echo
for extension in "$flashed" elf map; do echo "$image.$extension"; done
echo
echo "to flash it: astrolabe flash $image.$flashed"
