#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# data/unpack.sh [DEST]: unpacks the drive (DEST/kitti_raw_0005) and the compressed maps (DEST/maps) for tests and
# trials. DEST is build/data by default. Each folder appears whole or not at all; a complete one is left alone.
set -eu

here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
dest=${1:-$here/../build/data}
mkdir -p -- "$dest"
dest=$(CDPATH='' cd -- "$dest" && pwd)

temporary=
trap 'test -z "$temporary" || rm -rf -- "$temporary"' EXIT
trap 'exit 1' HUP INT TERM

# is_complete FOLDER SUMS: every file is there and is the right one, byte by byte.
is_complete() {
  (cd -- "$1" && sha256sum --status -c "$2") 2>/dev/null
}

# extract NAME: into $temporary/NAME.
extract() {
  case $1 in
    kitti_raw_0005)
      tar -xJf "$here/$1/$1.tar.xz" --no-same-owner -C "$temporary"
      ;;
    maps)
      mkdir "$temporary/$1"
      xz -dc "$here/$1/fr_079_t1_model.ot.xz" >"$temporary/$1/fr_079_t1_model.ot"
      bzip2 -dc "$here/$1/scan.dat.bz2" >"$temporary/$1/scan.dat"
      ;;
  esac
}

unpacked=
for name in kitti_raw_0005 maps; do
  sums=$here/$name/SHA256SUMS
  if [ -e "$dest/$name" ]; then
    is_complete "$dest/$name" "$sums" && continue
    echo "unpack.sh: $dest/$name is there but is not what is unpacked here; remove it first" >&2
    exit 1
  fi
  temporary=${temporary:-$(mktemp -d "$dest/.unpack.XXXXXX")}
  extract "$name"
  if ! is_complete "$temporary/$name" "$sums"; then
    echo "unpack.sh: $here/$name does not unpack to the files of its SHA256SUMS" >&2
    exit 1
  fi
  mv -T -- "$temporary/$name" "$dest/$name"
  unpacked="$unpacked $name"
done
if [ -n "$unpacked" ]; then
  echo "unpacked into $dest:$unpacked"
else
  echo "already unpacked in $dest: kitti_raw_0005 maps"
fi
