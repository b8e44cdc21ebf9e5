#!/bin/sh
# Starts the program of its own name from wherever this archive was unpacked. The program's own libraries are in lib/, where it looks for
# them itself. A driver brings a C++ runtime of the machine's into the process: the newer of the two must serve both, so
# the carried one is taken only where the machine has none or an older one. The same applies to libEGL, the drivers' loader.
self=$(readlink -f -- "$0")
here=$(dirname -- "$self")
fallback=$here/../lib/fallback

# has LIBRARY [WORD]: the machine has that library, with that word in it.
has() {
  for folder in $(printf '%s' "$LD_LIBRARY_PATH" | tr ':' ' ') /lib/x86_64-linux-gnu /usr/lib/x86_64-linux-gnu /lib64 \
    /usr/lib64 /usr/local/lib /usr/lib; do
    if [ -e "$folder/$1" ] && grep -qF -- "$2" "$folder/$1"; then return 0; fi
  done
  return 1
}

carried=
has libstdc++.so.6 GLIBCXX_3.4.30 || carried=$fallback/cxx
has libEGL.so.1 eglGetProcAddress || carried=$carried${carried:+:}$fallback/egl
if [ -n "$carried" ]; then
  LD_LIBRARY_PATH=$carried${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
  export LD_LIBRARY_PATH
fi
OPENIMAGEIO_FONTS=${OPENIMAGEIO_FONTS:-$here/../share/footprint/fonts}
export OPENIMAGEIO_FONTS
exec "$here/../libexec/$(basename -- "$self")" "$@"
