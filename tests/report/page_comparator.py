"""Checks of the page's comparator: images side by side, values under the cursor, error maps, zoom and links."""

import json
import re
import subprocess


def wait_for_pictures(browser):
    browser.wait_for("""Promise.all([...document.querySelectorAll('.picture img')].map(
        (image) => image.decode().catch(() => null)))""")


def wait_for_values(browser):
    """Until the values of the images that are shown are there."""
    browser.wait_for("""new Promise((done) => { const look = () => [chosen('a'), chosen('b')].every(valuesOf)
        ? requestAnimationFrame(() => requestAnimationFrame(done)) : setTimeout(look, 20); look(); })""")


TEXT = "return document.querySelector(arguments[0]).textContent"
THUMBS = "return [...document.querySelectorAll('.thumb img')].map((image) => image.getAttribute('src'))"


def texels(file):
    """RGB of an EXR, as oiiotool prints it: {(x, y): (r, g, b)}."""
    dump = subprocess.run(["oiiotool", "--dumpdata", file], check=True, capture_output=True, text=True).stdout
    pixels = re.findall(r"Pixel \((\d+), (\d+)\): (\S+) (\S+) (\S+)", dump)
    return {(int(x), int(y)): tuple(map(float, rgb)) for x, y, *rgb in pixels}


def displayed(value):
    value = min(max(value, 0), 1)
    return round(255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055))


ROWS = """return Object.fromEntries([...document.querySelectorAll('#readout tbody tr')].map((row) => [row.dataset.name,
    ['linear', 'displayed', 'pixel-error'].map((name) => (row.querySelector('.' + name)?.textContent ?? '').split(/\\s+/)
        .filter(Boolean).map(Number))]))"""
EXPOSURE = 0.84  # of the example


def check_values(browser, folder):
    """The values under the cursor are the EXR's, within a 16-bit float; displayed ones follow the exposure."""
    exact = {"reference": texels(folder / "images/reference_d1.exr"), "toksvig": texels(folder / "images/method2_d1.exr")}
    browser.show("#stage")
    browser.act(("mouse", [(40, -60)]))
    wait_for_values(browser)
    browser.settle()
    seen = []
    for stops, keys in ((0, ""), (1, "]]"), (-1, "[[[[")):
        if keys:
            browser.press(keys)
        x, y = map(int, re.findall(r"\d+", browser.run(TEXT, "#readout caption")))
        rows = browser.run(ROWS)
        assert list(rows) == ["reference", "toksvig"], rows
        for name, (linear, shown, error) in rows.items():
            true = exact[name][x, y]
            assert true[0] > 0.02, f"pixel {x}, {y} is in the shadow"
            assert all(abs(a - b) <= 2 ** -10 * b for a, b in zip(linear, true)), (name, linear, true)
            wanted = [displayed(EXPOSURE * 2 ** stops * value) for value in true]
            assert all(abs(a - b) <= 1 for a, b in zip(shown, wanted)), (name, stops, shown, wanted)
        difference = [min(EXPOSURE * a, 1) - min(EXPOSURE * b, 1) for a, b in zip(exact["toksvig"][x, y], exact["reference"][x, y])]
        wanted = (sum(d * d for d in difference) / 3) ** 0.5
        assert abs(rows["toksvig"][2][0] - wanted) <= 0.01 * wanted + 1e-4, (rows["toksvig"], wanted)
        seen.append(rows["toksvig"][1])
    assert seen[1] > seen[0] > seen[2], seen
    browser.press("]]")
    before = (x, y)
    browser.press("\ue014\ue014\ue015")  # arrows: right, right, down
    assert tuple(map(int, re.findall(r"\d+", browser.run(TEXT, "#readout caption")))) == (before[0] + 2, before[1] + 1)


def check_flip(browser):
    """Keys choose images and flip between them in place; a second flip restores every pixel."""
    browser.press("f1")
    assert browser.run("return [state.mode, state.b]") == ["flip", "direct"]
    browser.press("3")
    toksvig = browser.drawing()
    browser.press(" ")
    reference = browser.drawing()
    browser.press(" ")
    assert browser.drawing() == toksvig and reference != toksvig
    browser.press("2")
    assert browser.drawing() not in (toksvig, reference), "another image is drawn"
    browser.press("r")
    assert browser.run("return chosen('b').name") == "reference"
    browser.press("3s")


def check_slider(browser):
    """The line follows pointer, touch and keys."""
    assert browser.run("return state.mode") == "slider"
    browser.show("#stage")
    browser.act(("mouse", [(0, 0), "down", (-40, 0), (-120, 0), "up"]))
    width = browser.run("return document.querySelector('#panes canvas').clientWidth")
    split = browser.run("return state.split")
    assert abs(split - (50 - 100 * 120 / width)) < 1, (split, width)
    left = browser.drawing()
    browser.keys("#split", "\ue014\ue014")  # arrow right, twice
    browser.settle()
    assert browser.run("return state.split") > split and browser.drawing() != left
    browser.act(("touch", [(0, 30), "down", (60, 30), (100, 30), "up"]))
    assert abs(browser.run("return state.split") - (50 + 100 * 100 / width)) < 1
    browser.run("changeComparator({split: 50})")


def check_zoom_and_pan(browser, folder):
    """Side by side, both images follow one zoom and pan to the pixel: with one image on both sides they stay equal."""
    reference = texels(folder / "images/reference_d1.exr")
    sides = lambda: [browser.drawing(f"#panes canvas:nth-child({i})") for i in (1, 2)]
    browser.press("d")
    browser.run("changeComparator({a: 'toksvig', b: 'toksvig'})")
    wait_for_values(browser)
    browser.settle()
    fitted = sides()
    assert fitted[0] == fitted[1]
    browser.wheel(60, 40, -480)
    zoomed = sides()
    assert zoomed[0] == zoomed[1] != fitted[0], "the wheel zooms both"
    zoom, center = browser.run("return [state.zoom, state.center]")
    browser.act(("mouse", [(-80, 0), "down", (-60, 10), (-40, 25), "up"]))
    panned = sides()
    assert panned[0] == panned[1] != zoomed[0], "a drag pans both"
    moved = browser.run("return state.center")
    assert all(abs((a - b) * zoom - d) < 0.51 for a, b, d in zip(center, moved, (40, 25))), (center, moved, zoom)
    browser.act(("touch", [(60, 0), "down", (90, 0), (120, 0), "up"]), ("touch", [(20, 0), "down", (0, 0), (-40, 0), "up"]))
    assert abs(browser.run("return state.zoom") / zoom - 4) < 0.4, "two fingers zoom"
    browser.run("changeComparator({zoom: 16, center: [128, 100]})")
    browser.settle()
    blocks = browser.wait_for("""new Promise((done) => {
      const image = new Image();
      image.onload = () => {
        const canvas = Object.assign(document.createElement('canvas'), {width: image.width, height: image.height});
        const context = canvas.getContext('2d', {willReadFrequently: true});
        context.drawImage(image, 0, 0);
        const at = (x, y) => context.getImageData(x, y, 1, 1).data.join();
        const left = Math.round(image.width / 2), top = Math.round(image.height / 2);
        done([0, 1, 2, 3, 4].map((k) => [at(left + 16 * k + 1, top + 1), at(left + 16 * k + 14, top + 14)]));
      };
      image.src = 'data:image/png;base64,%s';
    })""" % browser.drawing())
    assert all(first == second for first, second in blocks), "a pixel is a block of one colour"
    assert len({first for first, _ in blocks}) > 2, blocks
    browser.press("0")
    assert browser.run("return state.zoom") is None and sides() == fitted
    browser.press("w")
    center = browser.run("return state.center")
    errors = {}
    for (x, y), rgb in texels(folder / "images/method2_d1.exr").items():
        region = (x // 32, y // 32)
        pair = zip(rgb, reference[x, y])
        errors[region] = errors.get(region, 0) + (sum((min(EXPOSURE * a, 1) - min(EXPOSURE * b, 1)) ** 2 for a, b in pair) / 3) ** 0.5
    worst = max(errors, key=errors.get)
    assert center == [32 * worst[0] + 16, 32 * worst[1] + 16], (center, worst)
    browser.press("0")
    browser.run("changeComparator({a: 'reference'})")


def check_maps(browser):
    """Every map is another image with a legend; FLIP's is the file; shares of the closest method add up."""
    browser.press("f")
    seen = [browser.drawing()]
    for name in ("error", "flip", "signed", "winner"):
        browser.run("changeComparator({map: arguments[0]})", name)
        browser.wait_for("""new Promise((done) => { const look = () => (closest.images.every(valuesOf) && pngOf(chosen('b').flip).complete)
            ? done() : setTimeout(look, 20); look(); })""")
        browser.settle()
        seen.append(browser.drawing())
        assert browser.run(TEXT, "#legend"), name
    assert len(set(seen)) == 5, "two maps are one"
    shares = [float(share) for share in re.findall(r"([0-9.]+)%", browser.run(TEXT, "#legend"))]
    assert len(shares) == 5 and abs(sum(shares) - 100) < 0.3, shares
    by_hand = browser.run("""const [reference, ...all] = closest.images.map(valuesOf), wins = [0, 0, 0, 0, 0];
        for (let i = 0; i < reference.coverage.length; ++i) {
          if (reference.coverage[i] !== 255) continue;
          const errors = all.map(({rgb}) => Math.hypot(...[0, 1, 2].map((c) =>
            Math.min(0.84 * rgb[3 * i + c], 1) - Math.min(0.84 * reference.rgb[3 * i + c], 1))) / Math.sqrt(3));
          const sorted = [...errors].sort((a, b) => a - b);
          ++wins[sorted[1] - sorted[0] > 1 / 255 ? 1 + errors.indexOf(sorted[0]) : 0];
        }
        const sum = wins.reduce((a, b) => a + b); return wins.map((count) => 100 * count / sum)""")
    assert all(abs(a - b) < 0.06 for a, b in zip(shares, by_hand[1:] + by_hand[:1])), (shares, by_hand)
    browser.run("changeComparator({map: 'image', mode: 'slider'})")


def check_links(browser, folder):
    """An address restores the whole comparator, to the pixel."""
    browser.run("changeComparator({a: 'direct', b: 'naive_mip', mode: 'slider', map: 'error', top: 0.25, zoom: 6, center: [140, 90], split: 30, stops: 1.5})")
    browser.click("#distances label:nth-of-type(2)")
    wait_for_values(browser)
    browser.settle()
    kept = "return JSON.stringify([state.a, state.b, state.mode, state.map, state.top, state.zoom, state.center, state.split, state.stops, state.distance])"
    seen, address, state = browser.drawing(), browser.run("return location.hash"), browser.run(kept)
    browser.send("POST", "/url", {"url": "about:blank"})
    browser.send("POST", "/url", {"url": (folder / "index.html").as_uri() + address})
    browser.show("#stage")
    wait_for_values(browser)
    browser.settle()
    assert browser.run(kept) == state, (browser.run(kept), state)
    assert browser.drawing() == seen, "the link draws something else"
    browser.run("location.hash = 'a=nothing&mode=none&zoom=x&at=1&stops=99&map=magic&split=-1'")
    browser.settle()
    assert json.loads(browser.run(kept))[2:9] == ["slider", "image", None, None, None, 50, 0], browser.run(kept)
    browser.run("location.hash = ''")
    browser.settle()
