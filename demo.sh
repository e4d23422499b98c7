#!/usr/bin/env bash
# Installs what is missing, builds the heel command, and follows a person through real recordings.
#   ./demo.sh [DATA]     DATA: the folder that holds six_people and one_person
#                        (default: $HEEL_DATA, else ../shared/data)
set -euo pipefail
cd "$(dirname "$0")"

.ci/setup
[ -f build/release/build.ninja ] || cmake --preset release --log-level=WARNING
cmake --build --preset release --target heel_command
heel=build/release/apps/heel/heel

data=${1:-${HEEL_DATA:-../shared/data}}
if [ ! -d "$data/six_people" ]; then
  cat <<EOT
heel is built: $heel --help

No recording in $data. To try it, record one (or take any RGB-D sequence in the TUM layout):
a still camera, 5 seconds of empty room, then one person who walks in and about. A folder with
  rgb.txt, depth.txt    "stamp filename" a line
  camera.yaml           width, height, fx, fy, cx, cy, depth_scale
Then:
  $heel learn FOLDER --out person.yaml
  $heel track FOLDER --model person.yaml --out out/
EOT
  exit 0
fi

"$heel" learn "$data/six_people" --out out/person.yaml
for recording in six_people one_person; do
  [ -d "$data/$recording" ] || continue
  "$heel" track "$data/$recording" --model out/person.yaml --out "out/$recording"
done
