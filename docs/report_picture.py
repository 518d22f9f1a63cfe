"""Takes the picture of a report that README.md shows: docs/report.png, remade when the page has changed.

    python3 docs/report_picture.py build/quick/compiler/dashpot

Needs chromium. The page is shown without its equations, from the top, as far as the first row of charts.
"""
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
NETWORK = ROOT / "networks/paper/second_order_maxwell.json"
PICTURE = ROOT / "docs/report.png"
WITHOUT = "<style>#equations { display: none }</style></head>"
SIZE = (1100, 1010)  # [px]
MOST_BYTES = 150_000

with tempfile.TemporaryDirectory() as name:
    page = pathlib.Path(name) / "report.html"
    subprocess.run([sys.argv[1], "report", str(NETWORK), "-o", str(page)], check=True)
    page.write_text(page.read_text().replace("</head>", WITHOUT, 1))
    subprocess.run(["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                    f"--user-data-dir={name}",
                    f"--window-size={SIZE[0]},{SIZE[1]}", f"--screenshot={PICTURE}", page.as_uri()],
                   check=True, stderr=subprocess.DEVNULL)
size = PICTURE.stat().st_size
print(f"{PICTURE.relative_to(ROOT)}: {size} bytes")
sys.exit(size > MOST_BYTES)
