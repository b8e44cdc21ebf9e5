"""Images as arrays, read by OpenImageIO."""
from footprint.program import Error


def read_image(path):
    """The pixels of an image file, (height, width, channels), as stored.

    An .exr of the program is linear radiance with coverage in alpha, float32; a .png is displayed colours, uint8.
    """
    try:
        import OpenImageIO
    except ImportError as error:
        raise ImportError("images need OpenImageIO: install the package python3-openimageio") from error
    as_stored = OpenImageIO.ImageSpec()
    as_stored["oiio:UnassociatedAlpha"] = 1
    file = OpenImageIO.ImageInput.open(str(path), as_stored)
    pixels = file and file.read_image(file.spec().format)
    if pixels is None:
        raise Error(f"{path}: {file.geterror() if file else OpenImageIO.geterror()}")
    return pixels
