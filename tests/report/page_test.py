"""Opens index.html in headless Chromium, from disk, and uses it: page_test.py FIXTURE_PROGRAM [FOLDER].

Speaks plain WebDriver to chromedriver on the loopback. FOLDER keeps the pages and the screenshots. Exit code 77
(skipped) where chromium or chromedriver is not installed.
"""

import pathlib
import subprocess
import sys
import tempfile

from browser import started_browser
from page_comparator import (check_flip, check_links, check_maps, check_slider, check_values, check_zoom_and_pan, ROWS, TEXT,
                             THUMBS, wait_for_pictures, wait_for_values)
from page_figures import (check_best, check_cautions, check_costs, check_distances, check_equal_titles, check_filters,
                          check_front, check_pairs, check_sparkle, check_table, open_details)


def check_first_sight(browser):
    """The answer and its images come first, then the comparator, the plot, the table of six columns, the caveats."""
    wait_for_pictures(browser)
    answer = browser.run("return [...document.querySelectorAll('#answer p')].map((node) => node.textContent)")
    assert answer[0].startswith("toksvig is the most accurate: error 4.0e-04 (-98% against direct), at 1.24 times"), answer
    names = browser.run("return [...document.querySelectorAll('.thumb strong')].map((node) => node.textContent)")
    assert names[0] == "reference" and names[-1] == "toksvig" and "direct" in names, names
    widths = browser.run("return [...document.querySelectorAll('.picture img')].map((image) => image.naturalWidth)")
    assert widths == [256] * len(names), widths
    tops = browser.run("""return ['#answer', '#thumbs', '#comparator', '#plot', '#table', '#words-section', '#caution', '#provenance']
        .map((name) => document.querySelector(name).getBoundingClientRect().top)""")
    assert tops == sorted(tops) and tops[2] < 900, tops
    assert browser.run("return document.querySelectorAll('#table tbody tr').length") == 4
    heads = browser.run("return [...document.querySelectorAll('#table thead th')].map((cell) => cell.textContent)")
    assert heads == ["Method", "Error", "vs direct", "= spp", "Cost", "Memory"], heads
    drawn = browser.run("""const canvas = document.getElementById('plot');
        const bytes = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
        return new Set(new Uint32Array(bytes.buffer)).size""")
    assert drawn > 20, f"the plot has {drawn} colours"
    colours = browser.run("return methods.map((method) => palette.light[placeOfColor.get(method)])")
    assert colours == ["#444444", "#b5488a", "#0072b2", "#d55e00"], f"methods have the colours of other figures: {colours}"
    labels = browser.run("return Chart.getChart('plot').data.datasets.map((set) => set.label)")
    assert labels == ["direct", "naive_mip", "toksvig", "toksvig:storage=unorm8", "plain supersampling",
                      "noise floor", "Pareto front"], labels
    named = browser.run("return Chart.getChart('plot').$named")
    assert {"direct", "naive_mip", "toksvig"} <= set(named), f"methods are named at their points: {named}"
    assert browser.run("return !document.getElementById('floor-note').hidden"), "one error is at the noise floor"
    assert browser.run("return document.querySelectorAll('#details details[open]').length") == 0, "details are folded"


def check_looks(browser, folder):
    colors = {}
    for name, scheme, width in (("light", "light", 1280), ("dark", "dark", 1280), ("narrow", "light", 390)):
        browser.emulate(scheme)
        browser.resize(width, 900)
        height = browser.run("window.scrollTo(0, 0); return document.documentElement.scrollHeight")
        overflow = browser.run("return document.documentElement.scrollWidth - window.innerWidth")
        assert overflow <= 0, f"{name}: the page is {overflow} pixels too wide"
        table = browser.run("const box = document.querySelector('.scroll:has(#table)'); return box.scrollWidth - box.clientWidth")
        assert table <= 0, f"{name}: the table is {table} pixels too wide"
        text = browser.run("return parseFloat(getComputedStyle(document.querySelector('#table td')).fontSize)")
        assert text >= 12, f"{name}: the table has letters of {text} pixels"
        browser.resize(width, height)
        colors[name] = browser.screenshot(folder / f"{name}.png")
        assert len(colors[name]) > 100, f"{name}: the screenshot has {len(colors[name])} colours"
    assert set(colors["light"]) != set(colors["dark"]), "light and dark look the same"
    browser.emulate("light")
    browser.resize(1280, 900)


def check_reading(browser):
    """Charts name every distance and say which lines are dashed; columns without figures are left out; menus fit."""
    ticks = "return Chart.getChart('trend-error').scales.x.ticks.map((tick) => tick.label)"
    assert browser.run(ticks) == ["1", "4", "16"], browser.run(ticks)
    legend = browser.run("return Chart.getChart('plot').legend.legendItems.map((item) => item.text)")
    assert legend[-2:] == ["noise floor (dashed)", "Pareto front (dotted)"], legend
    heads = "return [...document.querySelectorAll('#table thead th')].map((cell) => cell.textContent)"
    browser.click("#all-columns")
    assert "Left out" in browser.run(heads)
    browser.run("for (const record of records) record.display.effects_left_out = 'none'; showTable()")
    assert "Left out" not in browser.run(heads)
    browser.click("#all-columns")
    for width in (390, 1280):
        browser.resize(width, 900)
        browser.run("document.querySelector('.filter').open = true; window.scrollTo(0, 0)")
        left, right = browser.run("""const box = document.getElementById('methods').getBoundingClientRect();
            return [box.left, window.innerWidth - box.right]""")
        assert left >= 0 and right >= 0, (width, left, right)
    browser.run("document.querySelector('.filter').open = false")


def check_print(browser, folder):
    """On paper there are no controls, and it is light though the reader's system is dark."""
    browser.send("POST", "/goog/cdp/execute", {"cmd": "Emulation.setEmulatedMedia", "params": {
        "media": "print", "features": [{"name": "prefers-color-scheme", "value": "dark"}]}})
    style = "return getComputedStyle(document.querySelector(arguments[0])).%s"
    assert browser.run(style % "display", ".controls") == "none"
    assert browser.run(style % "backgroundColor", "body") == "rgb(255, 255, 255)"
    browser.wait_for("new Promise((done) => setTimeout(done, 200))")
    axis = "return Chart.getChart('plot').options.scales.x.title.color"
    assert browser.run(axis) in ("#000000", "#000"), browser.run(axis)
    browser.screenshot(folder / "print.png")
    browser.emulate("light")


def check_example(browser, folder):
    browser.open(folder / "index.html")
    check_first_sight(browser)
    check_values(browser, folder)
    check_flip(browser)
    check_slider(browser)
    check_zoom_and_pan(browser, folder)
    check_maps(browser)
    check_links(browser, folder)
    browser.open(folder / "index.html")
    open_details(browser)
    check_front(browser)
    check_costs(browser)
    check_sparkle(browser)
    check_cautions(browser)
    check_pairs(browser)
    check_distances(browser)
    check_best(browser)
    check_table(browser)
    check_filters(browser, folder)
    open_details(browser)
    check_equal_titles(browser)
    check_reading(browser)
    check_looks(browser, folder)
    check_print(browser, folder)
    assert not (messages := browser.complaints()), messages
    check_one_file(browser, folder)


def check_one_file(browser, folder):
    """The page with its pictures and values in it, alone in a folder: all are seen, and nothing is requested."""
    sent = folder / "sent"
    sent.mkdir(exist_ok=True)
    program = pathlib.Path(__file__).parents[2] / "scripts" / "one_file"
    subprocess.run([program, folder / "index.html", "-o", sent / "report.html"], check=True, stdout=subprocess.DEVNULL)
    browser.open(sent / "report.html")
    wait_for_pictures(browser)
    wait_for_values(browser)
    widths = browser.run("return [...document.querySelectorAll('.picture img')].map((image) => image.naturalWidth)")
    assert len(widths) > 1 and set(widths) == {256}, widths
    assert_asks_for_nothing(browser)
    assert not (messages := browser.complaints()), messages
    refused = subprocess.run([program, __file__, "-o", sent / "none.html"], check=False, capture_output=True)
    assert refused.returncode == 2 and b"is not a page" in refused.stderr and not (sent / "none.html").exists()


def assert_asks_for_nothing(browser):
    """No request to any host: everything shown was on this disk or in the page."""
    fetched = browser.run("return performance.getEntriesByType('resource').map((entry) => entry.name)")
    assert all(name.startswith(("file:", "data:")) for name in fetched), fetched


def check_matrix(browser, folder):
    """Members of a matrix: the scene is a column, and choosing one chooses what is looked at closely."""
    browser.open(folder / "index.html")
    heads = "return [...document.querySelectorAll('#table thead th')].map((cell) => cell.textContent)"
    assert browser.run(heads)[:3] == ["Method", "scene", "footprint"], browser.run(heads)
    rows = "return document.querySelectorAll('#table tbody tr').length"
    assert browser.run(rows) == 16
    focus = "return document.getElementById('focus').textContent"
    assert "surface_0, trilinear" in browser.run(focus)
    fronts = "return Chart.getChart('plot').data.datasets.filter((set) => set.label === 'Pareto front').length"
    assert browser.run(fronts) == 4
    open_details(browser)
    trend = "return Chart.getChart('trend-error').data.datasets[0].data.map((point) => point.count)"
    assert browser.run(trend) == [4, 4, 4], browser.run(trend)
    assert browser.run("return Chart.getChart('trend-flicker').data.datasets.length") == 4
    wait_for_pictures(browser)
    widths = browser.run("return [...document.querySelectorAll('.picture img')].map((image) => image.naturalWidth)")
    assert len(widths) > 1 and set(widths) == {256}, widths
    wait_for_values(browser)
    browser.resize(1280, browser.run("return document.documentElement.scrollHeight"))
    browser.screenshot(folder / "matrix.png")
    browser.resize(1280, 900)
    browser.run("location.hash = 'scene=surface_1&footprint=anisotropic:8'")
    browser.wait_for("new Promise((done) => setTimeout(done, 200))")
    assert browser.run(rows) == 4 and browser.run(fronts) == 1 and browser.run(trend) == [1, 1, 1]
    assert "surface_1, anisotropic:8" in browser.run(focus)
    assert browser.run("return document.querySelector('#axes select').value") == "surface_1"
    wait_for_pictures(browser)  # the fixture draws those of the first member alone
    missing = browser.run("return [...document.querySelectorAll('.missing')].map((node) => node.textContent)")
    assert len(missing) > 1 and all(text.startswith("surface_1-anisotropic_8/images/") for text in missing), missing
    choose = "const s = document.querySelector('#axes select'); s.value = ''; s.dispatchEvent(new Event('change'))"
    browser.run(choose)
    browser.settle()
    assert browser.run(rows) == 8 and "scene=" not in browser.run("return location.hash")
    browser.click("#table thead th:nth-child(2) button")
    scenes = browser.run("return [...document.querySelectorAll('#table tbody tr')].map((row) => row.cells[1].textContent)")
    assert scenes == sorted(scenes) and len(set(scenes)) == 2, scenes
    assert_asks_for_nothing(browser)
    messages = [text for text in browser.complaints() if "FILE_NOT_FOUND" not in text]
    assert not messages, messages


OPENED_WITHIN = 2000  # milliseconds, of a page of a thousand records with all of them in the table


def check_large(browser, folder):
    """Until the page is ready and the first rows are seen; programs beside it only ever add to that: the best of three."""
    times = []
    for _ in range(3):
        browser.send("POST", "/url", {"url": "about:blank"})
        browser.send("POST", "/url", {"url": (folder / "index.html").as_uri() + "#all=1"})
        times.append(browser.wait_for("""new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
            const [page] = performance.getEntriesByType('navigation');
            done(page.loadEventEnd - page.startTime); })))"""))
    print("a page of 1008 records opened in", ", ".join(f"{time:.0f}" for time in times), "ms")
    assert 0 < min(times) < OPENED_WITHIN, times
    rows = "return [...document.querySelectorAll('#table tbody tr')].map((row) => row.cells[4].textContent)"
    browser.wait_for("""new Promise((done) => { const look = () => document.querySelectorAll('#table tbody tr').length === 1008
        ? done() : setTimeout(look, 20); look(); })""")
    unsorted = browser.run(rows)
    browser.run("for (const i of [0, 1]) document.querySelector('#table th:nth-child(5) button').click()")
    browser.wait_for("""new Promise((done) => { const look = () => document.querySelectorAll('#table tbody tr').length === 1008
        ? done() : setTimeout(look, 20); look(); })""")
    number = lambda text: float(text.replace("≈", ""))
    assert [number(text) for text in browser.run(rows)] == sorted(map(number, unsorted))[::-1] and len(unsorted) == 1008
    assert_asks_for_nothing(browser)
    assert not (messages := browser.complaints()), messages


def check_hostile(browser, folder):
    browser.open(folder / "index.html")
    wait_for_pictures(browser)
    assert browser.run("return document.title").startswith("</script><script>"), "the title is not the scene's name"
    assert browser.run("return document.querySelector('h1').textContent").endswith("<b>&amp; {{data}}")
    assert browser.run("return document.querySelectorAll('#table tbody tr').length") == 4
    names = browser.run("return [...document.querySelectorAll('td.name')].map((cell) => cell.textContent)")
    assert any(name.startswith("<img") for name in names), names
    browser.run("changeComparator({mode: 'all'})")
    browser.settle()
    assert browser.run("return closest.images.filter((image) => pngOf(image.png).missing).length") == 1, "one picture is not there"
    assert "toksvig" in browser.run("return document.getElementById('plot-note').textContent")
    assert len(browser.screenshot(folder / "hostile.png")) > 100
    messages = [text for text in browser.complaints() if "absent" not in text]
    assert not messages, messages


def check_film(browser, folder):
    """The slider, a click into a chart and the arrow keys choose the frame; each image is that of its frame."""
    browser.open(folder / "index.html")
    sources = "return closest.images.map(({png}) => png)"
    of_frame = lambda i: [f"images/{name}_{i:04}.png" for name in ("reference", "a", "b")]
    assert browser.run(sources) == of_frame(1), browser.run(sources)
    assert browser.run("return document.querySelectorAll('#panes canvas').length") == 3, "all images are side by side"
    browser.keys("#frame", "\ue012")  # arrow left
    browser.settle()
    assert browser.run(sources) == of_frame(0), browser.run(sources)
    first = browser.drawing()
    browser.keys("#frame", "\ue014")  # arrow right
    browser.settle()
    assert browser.run(sources) == of_frame(1) and browser.drawing() != first, browser.run(sources)
    assert browser.run(TEXT, "#where") == "frame 1 of 2, 10°"
    browser.drag("#highlights", [200, 201])  # right of the middle: the last frame
    browser.settle()
    assert browser.run(sources)[0] == "images/reference_0002.png", browser.run(sources)
    assert "view=2" in browser.run("return location.hash")
    series = "return Chart.getChart(arguments[0]).data.datasets.map((set) => [set.label, set.data.map((p) => p.y)])"
    assert [label for label, _ in browser.run(series, "highlights")] == ["reference", "a", 'b:x=1,"y"']
    flicker = dict(browser.run(series, "flicker"))
    assert flicker["a"][0] is None and abs(flicker["a"][2] - 0.6) < 1e-9 and abs(flicker["a, p99"][2] - 0.9) < 1e-9, flicker
    assert dict(browser.run(series, "causes"))["filter"] == [None] * 3
    browser.click("#of-method label:nth-of-type(2)")
    assert dict(browser.run(series, "causes"))["filter"][1:] == [0.05, 0.05]
    ticks = browser.run("return Chart.getChart('error').scales.x.ticks.map((tick) => tick.label)")
    assert ticks == ["0", "1", "2"], ticks
    assert "a has the least error" in browser.run(TEXT, "#answer"), browser.run(TEXT, "#answer")
    browser.click("#play")
    browser.settle()
    browser.click("#play")
    assert len(browser.screenshot(folder / "film.png")) > 50
    messages = [text for text in browser.complaints() if "_values.js" not in text]  # the fixture has none of a film
    assert not messages, messages


def check_hostile_film(browser, folder):
    browser.open(folder / "index.html")
    assert browser.run("return document.title").startswith("</script><script>"), "the title is not the scene's name"
    names = browser.run("return [...document.querySelectorAll('td.name')].map((cell) => cell.textContent)")
    assert names[1].startswith("<img"), names
    assert browser.run("return document.querySelector('#video a').getAttribute('href')") == "images/film.mp4"
    messages = [text for text in browser.complaints() if "_values.js" not in text]
    assert not messages, messages


def check_views(browser, folder):
    """A page without runs: a choice of views, and sections with sentences, a command, a plot, a table and links."""
    browser.open(folder / "index.html")
    wait_for_pictures(browser)
    wait_for_values(browser)
    assert browser.run(TEXT, "#answer") == "b is chosen." and browser.run(TEXT, "#lede") == "Two views."
    assert browser.run("return ['views', 'details', 'path', 'filter'].map((id) => byId(id).hidden)") == [True] * 4
    assert browser.run(THUMBS) == ["reference_1.png", "a_1.png", "b_1.png"], browser.run(THUMBS)
    first = browser.drawing()
    browser.click("#distances label:nth-of-type(2)")
    wait_for_values(browser)
    browser.settle()
    assert browser.run(THUMBS)[0] == "reference_2.png" and browser.drawing() != first
    assert browser.run(TEXT, "#sections h2") == "steel </script>"
    assert browser.run(TEXT, "#sections pre") == "footprint bake <steel>"
    assert browser.run(TEXT, ".chosen-row") == "b0.05"
    assert browser.run("return document.querySelector('#sections a').getAttribute('href')") == "a%20b/index.html"
    sets = browser.run("""return Chart.getChart(document.querySelector('#sections canvas')).data.datasets.map(
        (set) => [set.label, set.data.map(({name}) => name ?? null)])""")
    assert sets == [["chosen", ["b"]], ["front", ["a"]], ["others", ["worse"]], ["limit", [None, None]]], sets
    browser.act(("touch", [(-30, -40), "down", "up"]))  # a tap
    assert browser.run("return Object.keys(%s)" % ROWS.removeprefix("return ")) == ["reference", "a"], "a tap reads values"
    browser.settle()
    address = browser.run("return location.hash")
    assert "view=1" in address, address
    for width in (390, 1280):
        browser.resize(width, 900)
        overflow = browser.run("return document.documentElement.scrollWidth - window.innerWidth")
        assert overflow <= 0, (width, overflow)
    browser.screenshot(folder / "views.png")
    assert_asks_for_nothing(browser)
    assert not (messages := browser.complaints()), messages


def main(fixture, keep=None):
    with tempfile.TemporaryDirectory() as temporary, started_browser() as browser:
        for kind, check in (("example", check_example), ("hostile", check_hostile), ("matrix", check_matrix),
                            ("large", check_large), ("views", check_views), ("film", check_film),
                            ("hostile_film", check_hostile_film)):
            folder = pathlib.Path(keep or temporary).resolve() / kind
            folder.mkdir(parents=True, exist_ok=True)
            subprocess.run([fixture, str(folder), kind], check=True)
            check(browser, folder)
    print("the page works in Chromium")


if __name__ == "__main__":
    main(*sys.argv[1:])
