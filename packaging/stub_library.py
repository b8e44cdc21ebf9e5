"""Writes a shared library that has another's name and the requested ones of its symbols, with nothing behind them:
functions do nothing and return the address of zeros, data is zero. For libraries that must be there to be loaded and are
never used: what a library sets up as it is loaded may call them (OpenImageIO asks readers for their version's words, and
DCMTK for a register of colour models), so they must not trap, and an empty string must come back."""
import pathlib
import re
import subprocess
import tempfile

# Number, value, size, type, binding, visibility, section, name[@[@]version].
SYMBOL = re.compile(r"^\s*\d+: [0-9a-f]+\s+(\w+) (\w+)\s+(\w+)\s+\w+\s+(?:\[.*?\] )?\s*(\w+) ([^\s@]+)(@@?)?(\S+)?")


class Symbol:
    """A dynamic symbol: its name, its version ("" for none), its type, its size in bytes, whether it is defined."""

    def __init__(self, size, kind, binding, section, name, version):
        self.name, self.version, self.kind, self.size = name, version or "", kind, int(size, 0)
        self.is_weak, self.is_defined = binding == "WEAK", section != "UND"

    @property
    def key(self):
        return self.name, self.version


def dynamic_symbols(library):
    """All of a library's or program's dynamic symbols."""
    text = subprocess.run(["readelf", "--dyn-syms", "-W", library], capture_output=True, text=True, check=True).stdout
    symbols = []
    for line in text.splitlines():
        if found := SYMBOL.match(line):
            size, kind, binding, section, name, _, version = found.groups()
            symbols.append(Symbol(size, kind, binding, section, name, version))
    return symbols


def assembly(symbols):
    """One label a symbol."""
    lines = [".bss", ".balign 64", "nothing: .zero 4096"]
    for symbol in symbols:
        lines += [f'.globl "{symbol.name}"']
        if symbol.kind in ("FUNC", "IFUNC", "GNU_IFUNC"):
            lines += [".text", f'.type "{symbol.name}", @function', f'"{symbol.name}": leaq nothing(%rip), %rax; ret']
        else:
            lines += [".bss", ".balign 16", f'.type "{symbol.name}", @object', f'.size "{symbol.name}", {symbol.size}',
                      f'"{symbol.name}": .zero {max(symbol.size, 1)}']
    return "\n".join(lines) + '\n.section .note.GNU-stack,"",@progbits\n'


def version_script(symbols):
    """The versions that the library defines, each with its symbols."""
    versions = {}
    for symbol in symbols:
        if symbol.version:
            versions.setdefault(symbol.version, []).append(symbol.name)
    return "\n".join("%s { global: %s };" % (version, " ".join(f'"{name}";' for name in names))
                     for version, names in sorted(versions.items()))


def write_stub(library, users, target):
    """Writes TARGET, with the soname of LIBRARY and what USERS take from it. Returns how many symbols that is."""
    wanted = {symbol.key for user in users for symbol in dynamic_symbols(user) if not symbol.is_defined}
    symbols = list({symbol.name: symbol for symbol in dynamic_symbols(library)
                    if symbol.is_defined and symbol.key in wanted}.values())
    soname = subprocess.run(["patchelf", "--print-soname", library], capture_output=True, text=True,
                            check=True).stdout.strip()
    with tempfile.TemporaryDirectory() as folder:
        source, script = pathlib.Path(folder, "stub.s"), pathlib.Path(folder, "versions")
        source.write_text(assembly(symbols))
        script.write_text(version_script(symbols))
        command = ["gcc", "-shared", "-nostdlib", f"-Wl,-soname,{soname}", "-o", target, source]
        if script.stat().st_size:
            command.append(f"-Wl,--version-script={script}")
        subprocess.run(command, check=True)
    return len(symbols)
