#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Builds the image of apps/batch/Containerfile, and runs the workflow in it. As root, from Debian's
# buildah and debootstrap; the package has to be there (cmake --workflow --preset package).
#   container.sh [FOLDER]   works there, on Debian's own system in place of a registry's
set -euo pipefail
cd "$(dirname "$0")/../.."

folder=${1:-$(mktemp -d)}
[ $# -gt 0 ] || trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder"/{data,root}
# Neither namespaces nor a file system of layers: it also runs within a container.
export STORAGE_DRIVER=vfs BUILDAH_ISOLATION=chroot
buildah() { command buildah --root "$folder/store" --runroot "$folder/run" "$@"; }

base=$(sed -n 's/^FROM //p' apps/batch/Containerfile)
[ -x "$folder/root/bin/sh" ] || debootstrap --variant=minbase bookworm "$folder/root" >"$folder/log"
container=$(buildah from scratch)
buildah add --quiet "$container" "$folder/root" /
buildah commit --quiet --rm "$container" "$base"
buildah build --quiet --pull=never --file apps/batch/Containerfile --tag heel .

inside() {
  buildah run --volume "$folder/data:/data" "$container" -- "$@"
}
container=$(buildah from --pull=never heel)
inside heel simulate wardrobe --duration 14 --out room
printf '%s\n' 'recordings: [room]' 'learn: {anna: room}' > "$folder/data/config.yaml"
inside snakemake --snakefile /usr/share/heel/batch/Snakefile --configfile config.yaml --cores 2
[ -s "$folder/data/batch/summary/summary.html" ]
grep -q '^room-[0-9a-f]*\.anna,0,' "$folder/data/batch/summary/summary.csv"
echo "container.sh: all as promised"
