"""Draws a table as one panel of curves, as SVG that stands alone.

    python3 examples/draw.py TABLE.csv "Title" > picture.svg

The table's header is `curve,X LABEL,Y LABEL`; each row has the name of its curve, x and y.
"""
import csv
import math
import sys

COLOURS = ["#0b5fa5", "#c1440e", "#2f8f5b", "#8a4fa8"]  # apart in grey too
DASHES = ["", "7 3", "2 3", "9 3 2 3"]
WIDTH, HEIGHT = 640, 360
LEFT, RIGHT, TOP, BOTTOM = 64, 624, 62, 310  # [px] of the panel


def ticks(low, high):
    """Round numbers, four to eight of them, from below `low` to above `high`."""
    span = (high - low) or 1
    step = 10 ** math.floor(math.log10(span / 4))
    step *= next(factor for factor in (1, 2, 5, 10) if span / (step * factor) <= 6)
    return [step * i for i in range(math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9) + 1)]


def text(x, y, words, anchor="middle", more=""):
    words = words.replace("&", "&amp;").replace("<", "&lt;")
    return f'<text x="{x:.0f}" y="{y:.0f}" text-anchor="{anchor}"{more}>{words}</text>'


def draw(rows, title):
    (_, x_label, y_label), *rows = rows
    curves = {}
    for name, x, y in rows:
        curves.setdefault(name, []).append((float(x), float(y)))
    points = [point for curve in curves.values() for point in curve]
    x_ticks, y_ticks = (ticks(min(values), max(values)) for values in zip(*points))

    def place(x, y):
        return (LEFT + (x - x_ticks[0]) / (x_ticks[-1] - x_ticks[0]) * (RIGHT - LEFT),
                BOTTOM - (y - y_ticks[0]) / (y_ticks[-1] - y_ticks[0]) * (BOTTOM - TOP))

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
           f'font-size="13">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
           text(LEFT, 22, title, "start", ' font-size="15" font-weight="bold"')]
    for x in x_ticks:
        at = place(x, y_ticks[0])[0]
        out += [f'<path d="M{at:.1f} {TOP}V{BOTTOM}" stroke="#ddd"/>', text(at, BOTTOM + 18, f"{x:.6g}")]
    for y in y_ticks:
        at = place(x_ticks[0], y)[1]
        out += [f'<path d="M{LEFT} {at:.1f}H{RIGHT}" stroke="#ddd"/>', text(LEFT - 6, at + 4, f"{y:.6g}", "end")]
    out += [text((LEFT + RIGHT) / 2, HEIGHT - 12, x_label),
            text(0, 0, y_label, more=f' transform="translate(16 {(TOP + BOTTOM) // 2}) rotate(-90)"')]
    legend = LEFT
    for (name, curve), colour, dashes in zip(curves.items(), COLOURS, DASHES):
        line = " ".join("{:.1f},{:.1f}".format(*place(x, y)) for x, y in curve)
        style = f'fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dashes}"'
        out.append(f'<polyline points="{line}" {style}/>')
        if len(curves) > 1:
            out += [f'<path d="M{legend} 44h28" {style}/>', text(legend + 34, 48, name, "start")]
            legend += 54 + 7 * len(name)
    return "\n".join(out + ["</svg>"])


if __name__ == "__main__":
    with open(sys.argv[1], newline="") as table:
        print(draw(list(csv.reader(table)), sys.argv[2]))
