#!/usr/bin/env bash
# Installs what is missing, builds the heel command, and follows people.
#   ./demo.sh [DATA]     DATA: the folder that holds the recordings six_people and one_person, which
#                        are tracked as well where they are (default: $HEEL_DATA, else ../shared/data)
set -euo pipefail
data=$(realpath -m "${1:-${HEEL_DATA:-$(dirname "$0")/../shared/data}}")
cd "$(dirname "$0")"

.ci/setup build
[ -f build/release/build.ninja ] || cmake --preset release --log-level=WARNING
cmake --build --preset release --target heel_command
heel=build/release/apps/heel/heel

echo
echo "== A simulated flat: a robot learns Lena and follows her through it"
"$heel" follow home --out out/home
echo "open out/home/report.html in a browser"

echo
echo "== A simulated room: who is Anna, and where does she go?"
[ -f out/wardrobe/truth.csv ] || { rm -rf out/wardrobe; "$heel" simulate wardrobe --out out/wardrobe; }
"$heel" learn out/wardrobe --out out/anna.yaml
"$heel" track out/wardrobe --model out/anna.yaml --out out/anna_in_wardrobe
"$heel" evaluate out/anna_in_wardrobe/tracks.csv out/wardrobe/truth.csv

echo
echo "for 'heel' as a command: export PATH=$PWD/build/release/apps/heel:\$PATH"

if [ ! -d "$data/six_people" ]; then
  cat <<EOT

There is no recording six_people in $data. To make one of your own: a still stereo or RGB-D camera, 5 seconds of empty room, then
one person who walks in and about. As RGB-D, a folder with
  rgb.txt, depth.txt    "stamp filename" a line (the layout of the TUM RGB-D data sets)
  camera.yaml           width, height, fx, fy, cx, cy, depth_scale
Then: $heel learn FOLDER --out person.yaml && $heel track FOLDER --model person.yaml --out out/person
EOT
  exit 0
fi

echo
echo "== Real people: the first to enter is learned, and followed"
"$heel" learn "$data/six_people" --out out/first.yaml
for recording in six_people one_person; do
  [ -d "$data/$recording" ] || continue
  "$heel" track "$data/$recording" --model out/first.yaml --out "out/first_in_$recording"
done
