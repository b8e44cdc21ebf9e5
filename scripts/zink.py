"""The environment in which a program's OpenGL is Mesa's zink, which renders by Vulkan, over lavapipe, Vulkan on the CPU.

Above the rasteriser it shares no driver with llvmpipe, so undefined behaviour of OpenGL has another result there, or ends
the program.
"""

import os
import pathlib

ICD_FOLDERS = ("/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d")


def lavapipe():
    """The manifest by which the Vulkan loader finds lavapipe; None if it is not installed."""
    found = [file for folder in ICD_FOLDERS for file in sorted(pathlib.Path(folder).glob("lvp_icd*.json"))]
    return found[0] if found else None


def environment(icd, runtime_folder):
    """This process's variables, and those that select zink over lavapipe's `icd`. `runtime_folder` must be private."""
    return os.environ | {
        "LIBGL_ALWAYS_SOFTWARE": "1",
        "GALLIUM_DRIVER": "zink",
        "VK_ICD_FILENAMES": str(icd),
        "XDG_RUNTIME_DIR": str(runtime_folder),
        # Constants that zink compiles in lead lavapipe of Mesa 22.3 to write past its table of them (32 x 4, indexed by
        # block x 32), and then to read a buffer that is not there: SIGSEGV, in any shader of four blocks with a branch.
        "ZINK_INLINE_UNIFORMS": "false",
    }
