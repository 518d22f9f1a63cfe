"""Runs the notebook of docs/ from its first cell to its last, as somebody who opens it does.

    python3 notebook_test.py [--update]

`--update` writes what the cells print and draw into the notebook, so that it can be read without running it.
"""
import ast
import base64
import contextlib
import io
import json
import os
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
NOTEBOOK = ROOT / "docs/python.ipynb"


def run_cell(source, names):
    """Runs the cell; the value of a last expression is shown unless a semicolon follows it, as a notebook does."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "cell", "eval"), names) if last else None
        if value is not None and not source.rstrip().endswith(";"):
            print(repr(value))
    return printed.getvalue()


def pictures():
    """What is drawn and not shown yet, as PNG."""
    import matplotlib.pyplot as plt
    drawn = []
    for number in plt.get_fignums():
        buffer = io.BytesIO()
        plt.figure(number).savefig(buffer, format="png", dpi=70, metadata={"Software": None})
        drawn.append(base64.b64encode(buffer.getvalue()).decode())
    plt.close("all")
    return drawn


def outputs(text, drawn):
    shown = [{"name": "stdout", "output_type": "stream", "text": text.splitlines(keepends=True)}] if text else []
    return shown + [{"data": {"image/png": picture}, "metadata": {}, "output_type": "display_data"}
                    for picture in drawn]


def main():
    notebook = json.loads(NOTEBOOK.read_text())
    names, count, figures = {"__name__": "__main__"}, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        pathlib.Path("networks").symlink_to(ROOT / "networks")
        for cell in notebook["cells"]:
            if cell["cell_type"] != "code":
                continue
            count += 1
            text = run_cell("".join(cell["source"]), names)
            drawn = pictures()
            figures += len(drawn)
            recorded = "".join("".join(output.get("text", [])) for output in cell["outputs"])
            if "--update" in sys.argv:
                cell.update(outputs=outputs(text, drawn), execution_count=count)
            elif text != recorded or len(drawn) != sum("data" in output for output in cell["outputs"]):
                sys.exit(f"cell {count} prints\n{text}and draws {len(drawn)} pictures; the notebook has\n{recorded}")
    os.chdir(ROOT)
    if "--update" in sys.argv:
        NOTEBOOK.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n")
    if figures < 3:
        sys.exit(f"{figures} pictures; relaxation, hysteresis and a fit are expected")
    print(f"{count} cells ran, {figures} pictures")


if __name__ == "__main__":
    main()
