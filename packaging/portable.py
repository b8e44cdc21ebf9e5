#!/usr/bin/env python3
"""Makes the portable archive of an installed tree: the program with the libraries that it needs (README.md).

  packaging/portable.py INSTALLED_TREE NAME OUTPUT.tar.xz [PROGRAM ...]

Further programs of a build (footprint_bench, a test) go beside it: what a machine is to be measured with.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import stub_library

HERE = pathlib.Path(__file__).resolve().parent
LIMIT = 60 * 2**20  # bytes of the archive

# Part of the C library or of a driver: always the machine's own.
SYSTEM = re.compile(r"^(ld-linux-x86-64|libc|libm|libdl|libpthread|librt)\.so")
# Carried, and used where the machine has none or an older one: a driver must not meet an older C++ runtime than its own.
FALLBACK = {"cxx": ["libstdc++.so.6", "libgcc_s.so.1"], "egl": ["libEGL.so.1", "libGLdispatch.so.0"]}
# Called by readers of OpenImageIO that Footprint never asks for (renderer/image/image_io.cpp lists those that it does).
UNUSED = re.compile(r"^(libopencv_|libdcm|liboflog|libofstd|libavcodec|libavformat|libavutil|libswscale|libgif|libheif"
                    r"|libopenjp2|libopenvdb|libraw)")
FONT = pathlib.Path("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")


def run(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def needed(library):
    return run("patchelf", "--print-needed", library).split()


def paths_of(program):
    """{soname: path} of all that a program loads, as this machine finds it."""
    found = re.findall(r"^\s*(\S+) => (/\S+)", run("ldd", program), re.MULTILINE)
    return {soname: pathlib.Path(path).resolve() for soname, path in found}


def carried(programs, paths):
    """The sonames to carry as they are, and those to carry as stubs: what is reached from the programs."""
    fallback = {name for names in FALLBACK.values() for name in names}
    whole, stubs, queue = set(), set(), list(programs)
    while queue:
        for soname in needed(queue.pop()):
            if SYSTEM.match(soname) or soname in whole | stubs | fallback:
                continue
            if UNUSED.match(soname):
                stubs.add(soname)
            else:
                whole.add(soname)
                queue.append(paths[soname])
    return whole, stubs


def keep_licence(path, folder):
    """The copyright file of the Debian package that a library comes from."""
    package = run("dpkg-query", "--search", f"*/{path.name}").split(":")[0]
    shutil.copyfile(f"/usr/share/doc/{package}/copyright", folder / package)


def carry_libraries(programs, tree):
    """Puts what the programs load into the tree's lib/."""
    paths = {}
    for program in programs:
        paths |= paths_of(program)
    whole, stubs = carried(programs, paths)
    libraries, licences = tree / "lib", tree / "share/doc/footprint/licences"
    licences.mkdir(parents=True)
    places = {soname: libraries / soname for soname in whole}
    places |= {soname: libraries / "fallback" / group / soname for group, names in FALLBACK.items() for soname in names}
    for soname, place in sorted(places.items()):
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(paths[soname], place)
        keep_licence(paths[soname], licences)
    users = programs + [places[soname] for soname in sorted(whole)]
    for soname in sorted(stubs):
        count = stub_library.write_stub(paths[soname], users, libraries / soname)
        print(f"{soname}: a stub with {count} symbols")
    for soname in sorted(whole | stubs):
        run("patchelf", "--set-rpath", "$ORIGIN", libraries / soname)
    print(f"{len(whole)} libraries are carried whole, {len(stubs)} as stubs")


def carry(programs, tree):
    """Puts the programs, each with a launcher of its name, and their libraries into the tree."""
    carry_libraries(programs, tree)
    (tree / "libexec").mkdir()
    for program in programs:
        moved, launcher = tree / "libexec" / program.name, tree / "bin" / program.name
        shutil.copy(program, moved)
        run("strip", moved)
        run("patchelf", "--set-rpath", "$ORIGIN/../lib", moved)
        shutil.copyfile(HERE / "launcher.sh", launcher)
        launcher.chmod(0o755)


def pack(tree, output, limit):
    """Writes the archive of a folder, unless it has more bytes than `limit`: then there is none, and an error."""
    unfinished = output.with_name(output.name + ".tmp")
    subprocess.run(["tar", "--create", "--use-compress-program=xz -9 -T0", f"--file={unfinished}", "--sort=name",
                    "--owner=0", "--group=0", "--numeric-owner", f"--directory={tree.parent}", tree.name], check=True)
    size = unfinished.stat().st_size
    if size > limit:
        unfinished.unlink()
        sys.exit(f"portable.py: the archive has {size} bytes, more than {limit}: what pulled so much in?")
    unfinished.rename(output)
    print(f"{output}: {size / 2**20:.1f} MiB")


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    installed, name, output = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
    programs = [installed / "bin/footprint"] + [pathlib.Path(word) for word in sys.argv[4:]]
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder, name)
        shutil.copytree(installed, tree)
        carry(programs, tree)
        (tree / "share/footprint/fonts").mkdir()
        shutil.copyfile(FONT, tree / "share/footprint/fonts" / FONT.name)
        keep_licence(FONT, tree / "share/doc/footprint/licences")
        pack(tree, output, LIMIT)


if __name__ == "__main__":
    main()
