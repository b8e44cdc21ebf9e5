"""Checks of the page's figures: the plot of error against cost, the table, filters, distances, pairs and cautions."""

import re

from page_comparator import TEXT, THUMBS, wait_for_pictures


def plot(browser):
    return browser.run("return document.getElementById('plot').toDataURL()")


def open_details(browser):
    browser.run("for (const node of document.querySelectorAll('.fold')) node.open = true")
    browser.settle()


def check_costs(browser):
    """The plot's cost is the frame time, or an estimate on a GPU where there is one."""
    assert browser.run("return document.getElementById('cost-tool').hidden"), "there is one kind of cost"
    browser.run("""records.forEach((record, i) => { record.gpu_costs = [{gpu: 'Steam Deck', cost_ns: 1 + i % 4, failure: null}]; });
        change({cost: 'Steam Deck'})""")
    points = browser.run("return Chart.getChart('plot').data.datasets.filter((set) => set.isMethod).map((set) => set.data[0].x)")
    assert points == [1, 2, 3, 4], points
    assert "Steam Deck" in browser.run("return Chart.getChart('plot').options.scales.x.title.text")
    browser.run("change({cost: ''})")


def check_sparkle(browser):
    """The reference's histogram and one per method, of all object pixels; bins without any lie at the foot."""
    series = browser.run("""return Chart.getChart('sparkle').data.datasets.map(
        (set) => [set.label, set.data.map((point) => point.count)])""")
    assert [label for label, _ in series] == ["reference", "direct", "naive_mip", "toksvig", "toksvig:storage=unorm8"]
    for label, counts in series:
        assert len(counts) == 32 and sum(counts) == 12345 and counts[20] == 0, (label, counts)
    assert len({counts[31] for _, counts in series}) == len(series), "methods sparkle alike"
    foot, heights = browser.run("""const plot = Chart.getChart('sparkle');
        return [plot.scales.y.min, plot.data.datasets[0].data.map((point) => point.y)]""")
    assert abs(heights[20] / foot - 1) < 1e-9 and heights[31] > foot, (foot, heights)


def check_distances(browser):
    words, drawn = browser.run(TEXT, "#words"), plot(browser)
    before = browser.run(THUMBS)
    browser.click("#distances label:nth-of-type(2)")
    after = browser.run(THUMBS)
    assert all("_d1.png" in source for source in before), before
    assert all("_d4.png" in source for source in after), after
    assert "over 60 interior pixels" in browser.run(TEXT, "#words")
    assert "150 object pixels" in browser.run(TEXT, "#pixels")
    assert words != browser.run(TEXT, "#words")
    assert drawn != plot(browser), "the plot did not follow the distance"
    sets, corner, least = browser.run("""const chart = Chart.getChart('plot');
        return [chart.data.datasets.map((set) => set.label), chart.options.corner, chart.scales.y.min]""")
    assert "noise floor" not in sets and "noise floor 0.0005, below this axis" in corner, (sets, corner)
    assert least > 0.005, "the axis ends at the data, not at a floor far below"
    wait_for_pictures(browser)


def check_pairs(browser):
    """Shares of every two methods, and the picture of those that are chosen."""
    cells = browser.run("return [...document.querySelectorAll('#pairs tbody td')].map((cell) => cell.textContent)")
    assert len(cells) == 20 and [cells[i] for i in (1, 7, 13, 19)] == ["–"] * 4, cells
    assert (cells[2], cells[6]) == ("0.0%", "20.0%"), cells
    hidden = "return document.getElementById('pair-view').hidden"
    assert browser.run(hidden), "a pair is shown without a choice"
    browser.click("#pairs tbody tr:nth-child(2) td:nth-child(4) button")
    wait_for_pictures(browser)
    assert not browser.run(hidden)
    caption = browser.run("return [...document.querySelectorAll('#pair-caption span')].map((part) => part.textContent)")
    assert caption[0] == "naive_mip is closer: 5.0%" and caption[1].startswith("toksvig is closer: "), caption
    assert browser.run("return document.querySelector('#pair-picture img').naturalWidth") == 256
    shares = [float(re.search(r"([0-9.]+)%", part)[1]) for part in caption]
    assert abs(sum(shares) - 100) < 0.11, caption


def check_cautions(browser):
    cautions = browser.run("return document.getElementById('caution').textContent")
    assert "At distance 16 there are fewer than 20 interior pixels" in cautions, cautions
    note = browser.run("const link = document.querySelector('#caveat-note a'); return [link.textContent, link.hash]")
    assert re.match(r"\d+ caveats? on this answer", note[0]) and note[1] == "#caution", note


def check_best(browser):
    """One method alone is first, and coloured; where frame times overlap none is."""
    best = "return [...document.querySelectorAll('#table td.best')].map((cell) => cell.closest('tr').cells[0].textContent)"
    assert browser.run(best) == ["toksvig", "toksvig"], browser.run(best)  # shading and worth; times overlap


def check_table(browser):
    """The least error is first; a click sorts; all columns and all distances are a click away."""
    errors = """return [...document.querySelectorAll('#table tbody tr')].map(
        (row) => parseFloat(row.cells[1].textContent.replace('≈', '')))"""
    rising = browser.run(errors)
    assert rising == sorted(rising), rising
    browser.click("#table thead th:nth-child(2) button")
    browser.click("#table thead th:nth-child(2) button")
    assert browser.run(errors) == rising[::-1]
    changes = browser.run("return [...document.querySelectorAll('#table tbody tr')].map((row) => row.cells[2].textContent)")
    assert "" in changes and all(re.fullmatch(r"[+-]\d+%|", text) for text in changes), changes
    browser.click("#all-distances")
    assert browser.run("return document.querySelectorAll('#table tbody tr').length") == 12
    browser.click("#all-distances")
    browser.click("#all-columns")
    assert browser.run("return document.querySelectorAll('#table thead th').length") > 15
    browser.click("#all-columns")


def check_front(browser):
    """Along the front time rises and error falls, and no point is left of it and below."""
    front, points = browser.run("""const sets = Chart.getChart('plot').data.datasets;
        return [sets.find((set) => set.label === 'Pareto front').data,
                sets.filter((set) => set.whiskers).flatMap((set) => set.data)]""")
    assert len(points) == 4 and 1 < len(front) <= 4, front
    for first, second in zip(front, front[1:]):
        assert first["x"] < second["x"] and first["y"] > second["y"], front
    for point in points:
        assert any(p["x"] <= point["x"] and p["y"] <= point["y"] for p in front), (point, front)


def check_filters(browser, folder):
    """Methods and distances that are left out leave the table and the plots; the address brings them back."""
    rows = "return document.querySelectorAll('#table tbody tr').length"
    drawn = "return Chart.getChart('plot').data.datasets.filter((set) => set.whiskers).map((set) => set.label)"
    browser.click(".filter summary")
    browser.click("#methods label:nth-of-type(2) input")
    assert browser.run(rows) == 3 and browser.run(drawn) == ["direct", "toksvig", "toksvig:storage=unorm8"]
    browser.click("#all-distances")
    assert browser.run(rows) == 9
    browser.click("#distances label:nth-of-type(2)")
    browser.click("#table thead th:nth-child(5) button")
    browser.settle()
    address = browser.run("return location.hash")
    cells = "return [...document.querySelectorAll('#table tbody td')].map((cell) => cell.textContent)"
    seen = browser.run(cells)
    browser.open(folder / "index.html")
    assert browser.run(rows) == 4, "an address without words shows all"
    browser.run("location.hash = arguments[0]", address)
    browser.wait_for("new Promise((done) => setTimeout(done, 200))")
    assert browser.run(cells) == seen, "the address does not bring back what was seen"
    assert browser.run("return document.querySelector('#distances input:checked').value") == "4"
    browser.run("location.hash = 'distance=3&without=unknown&sort=nothing'")
    browser.wait_for("new Promise((done) => setTimeout(done, 200))")
    assert browser.run(rows) == 4, "words of another page are passed over"


def check_equal_titles(browser):
    """The address keeps the column of the order, though another one has its title."""
    sort = "return [document.querySelector('#table th[aria-sort]').cellIndex, document.querySelector('#table th[aria-sort]').textContent]"
    browser.run("location.hash = ''; columns.find((column) => column.key === 'edges_error').title = 'Method'")
    browser.wait_for("new Promise((done) => setTimeout(done, 200))")
    browser.click("#all-columns")
    browser.click("#table thead th:nth-child(6) button")
    browser.settle()
    seen, address = browser.run(sort), browser.run("return location.hash")
    assert seen == [5, "Method"], seen
    browser.run("location.hash = ''")
    browser.wait_for("new Promise((done) => setTimeout(done, 200))")
    browser.run("location.hash = arguments[0]", address)
    browser.wait_for("new Promise((done) => setTimeout(done, 200))")
    assert browser.run(sort) == seen, (browser.run(sort), address)
    browser.click("#all-columns")
