#!/usr/bin/env bash
# The main job on a desk: a simulated robot whose wheels and wheelbase are off is calibrated over a real pseudo
# terminal by maximum likelihood over whole drives, driven again and reported.      demo.sh ASTROLABE FOLDER
set -euo pipefail
astrolabe=$1
folder=$2

rm -rf "$folder"
mkdir -p "$folder"
port=$folder/robot.pty

# The wheels differ by 0.416 %, the wheelbase is 0.479 % shorter than the robot believes, and the wheels slip as those
# of the robot that the numbers come from.
"$astrolabe" sim --pty "$port" --true-ed 1.00416 --true-wheelbase 0.28861 --slip 2.645e-6 --seed "${SEED:-1}" --fast \
  2>"$folder/sim.log" &
sim=$!
trap 'kill $sim 2>/dev/null || true; wait $sim 2>/dev/null || true' EXIT
for _ in $(seq 100); do
  [[ -e $port ]] && break
  kill -0 $sim 2>/dev/null || { cat "$folder/sim.log" >&2; exit 1; }
  sleep 0.05
done

"$astrolabe" umbmark --port "$port" --truth sim --runs 5 --side 3 --out "$folder/experiment" --yes

echo
echo "How the factors were found, from the drives before:"
"$astrolabe" calibrate runs "$folder/experiment/before"

echo
echo "The report with both: $folder/experiment/report.html"
