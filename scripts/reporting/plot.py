"""Draws the charts of a results folder as SVG: bench.json beside machine.json; accuracy and stability.json."""
from pathlib import Path

from accuracy_rows import read_accuracy, read_stability
from bench_rows import BadInput, describe_machine, main_guard, read_bench, read_json
from options import Parser
from portable import read_portable


def main():
    parser = Parser(prog="plot", description=__doc__, epilog="Exit status: 0 drawn, 2 bad input.")
    parser.add_argument("results", type=Path, metavar="RESULTS", help="folder with bench.json and machine.json")
    parser.add_argument("--out", type=Path, metavar="DIR", help="where the charts go (RESULTS/charts)")
    options = parser.parse_args()
    if not options.results.is_dir():
        raise BadInput(f"{options.results}: no such folder")
    bench = read_bench(options.results)
    accuracy, sweeps = read_accuracy(options.results), read_stability(options.results)
    machine = read_json(options.results / "machine.json")
    caption = describe_machine(machine)
    folder = options.out or options.results / "charts"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput(f"{folder}: {error.strerror}") from None

    import plot_accuracy
    import plot_growth
    import plot_ablation
    import plot_scenes
    import plot_stability
    import plot_stability_grid
    import plot_area
    import plot_displacement
    import plot_frontier
    import plot_portable
    charts = (*plot_area.CHARTS, *plot_scenes.CHARTS, *plot_ablation.CHARTS)
    drawn = [name for chart in charts if (name := chart(bench, folder, caption))]
    if growth := plot_growth.growth(bench, machine, folder, caption):
        drawn.append(growth)
    drawn += plot_scenes.against(bench, folder, caption)
    drawn += [*plot_accuracy.draw(accuracy, folder, caption), *plot_stability.draw(sweeps, accuracy, folder, caption)]
    if main_chart := plot_frontier.frontier(accuracy, folder, caption):
        drawn.append(main_chart)
    if strip := plot_displacement.strip(accuracy, folder, caption):
        drawn.append(strip)
    if shares := plot_portable.portable(read_portable(options.results), folder, caption):
        drawn.append(shares)
    if grid := plot_stability_grid.grid(sweeps, accuracy, folder, caption):
        drawn.append(grid)
    if not drawn:
        raise BadInput(f"{options.results}: no row that a chart shows")
    print(f"{len(drawn)} charts in {folder}: {' '.join(drawn)}")
    return 0


main_guard(main)
