// Published numbers on the chart of a quantity: hollow marks in the colour and shape of their series, the measured curve
// scaled to the paper's first number, and bands where the paper states no load. Pure, as charts.js is.
const publishedMarks = (() => {
    const { digits, withUnit } = chartStyle;
    const { columnOf, distinct, shown } = chartData;
    const rate = 'fps_avg', time = 'frame_ms_median';

    /// [min, max] of a number in the column of the chart, converted between frames per second and ms; null for another
    /// quantity.
    const rangeIn = (item, column) => {
        if (item.column === column) return [item.min, item.max];
        const reciprocal = [item.column, column].every(name => name === rate || name === time);
        return reciprocal ? [1000 / item.max, 1000 / item.min] : null;
    };
    const isOf = (item, cell) => cell.method === item.method &&
        Object.entries(item.settings).every(([name, value]) => cell.settings[name] === value);
    const rangeText = ([min, max], unit) => (min === max ? withUnit(min, unit, 3) : `${digits(min)} to ${withUnit(max, unit, 3)}`);
    const tipOf = (report, item, column, range, more = {}) => {
        const info = columnOf(report, column), printed = columnOf(report, item.column);
        return {
            title: 'published', ...more, [info.name]: rangeText(range, info.unit),
            ...(item.column === column ? {} : { 'as printed': rangeText([item.min, item.max], printed.unit) }),
            hardware: item.hardware, of: item.what,
        };
    };

    /// Interpolates a measured curve, linearly on logarithmic scales; null outside its range.
    const valueAt = (curve, x) => {
        const after = curve.findIndex(point => point.x >= x);
        if (after < 0) return null;
        if (curve[after].x === x) return curve[after].y;
        if (after === 0) return null;
        const [a, b] = [curve[after - 1], curve[after]];
        if (a.x <= 0 || a.y <= 0 || b.y <= 0) return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
        return a.y * (b.y / a.y) ** (Math.log(x / a.x) / Math.log(b.x / a.x));
    };
    /// The measured curve of a series over the paper's loads, scaled to pass through the paper's first number.
    const scaledCurve = (curve, marks) => {
        const sorted = [...marks].sort((a, b) => a.x - b.x);
        const first = sorted.find(mark => valueAt(curve, mark.x) > 0);
        if (!first) return null;
        const factor = first.y / valueAt(curve, first.x);
        const last = Math.min(sorted[sorted.length - 1].x, curve[curve.length - 1].x);
        const xs = distinct([first.x, ...curve.map(point => point.x).filter(x => x > first.x && x < last), last]);
        return xs.length < 2 ? null : { factor, points: xs.map(x => ({ x, y: factor * valueAt(curve, x) })) };
    };
    const factorText = factor => `${digits(factor)}×`;

    /// Marks, scaled curves and bands of a chart of curves. `points` are the measured ones, with panel, series, x and y.
    const along = (report, experiment, column, load, cells, points, theSeries, thePanel) => {
        const unit = columnOf(report, column).unit;
        const marks = [];
        for (const item of experiment.published.filter(one => one.axis === load.name)) {
            const range = rangeIn(item, column);
            if (!range) continue;
            const places = distinct(cells.filter(cell => isOf(item, cell)).map(cell => JSON.stringify([thePanel(cell), theSeries(cell)]))).map(JSON.parse);
            const [low, high] = range.map(value => shown(value, unit));
            for (const [panel, series] of places)
                marks.push({ panel, series, x: item.x, y: (low + high) / 2, low, high, hardware: item.hardware, tip: tipOf(report, item, column, range, { series, [load.name]: digits(item.x, 6, true) }) });
        }
        const scaled = [], factors = [];
        for (const key of distinct(marks.map(mark => JSON.stringify([mark.panel, mark.series])))) {
            const [panel, series] = JSON.parse(key);
            const isHere = row => row.panel === panel && row.series === series;
            const curve = scaledCurve(points.filter(isHere).sort((a, b) => a.x - b.x), marks.filter(isHere));
            if (!curve) continue;
            scaled.push(...curve.points.map(point => ({ ...point, panel, series, line: `line ${series}` })));
            factors.push({ panel, series, ...curve.points[curve.points.length - 1], text: factorText(curve.factor) });
        }
        return { marks, scaled, factors };
    };

    /// Numbers without a load, as bands over the whole chart. `colourOf(item)` is that of their series.
    const bands = (report, experiment, column, cells, colourOf) => experiment.published
        .filter(item => !item.axis && rangeIn(item, column) && cells.some(cell => isOf(item, cell)))
        .map(item => {
            const range = rangeIn(item, column), unit = columnOf(report, column).unit;
            const [min, max] = range.map(value => shown(value, unit));
            return { x: null, min, max, colour: colourOf(item), hardware: item.hardware, text: `published: ${rangeText(range, unit)}${item.column === column ? '' : ` (${rangeText([item.min, item.max], columnOf(report, item.column).unit)})`}`, tip: tipOf(report, item, column, range) };
        });

    /// Names without their common first words.
    const shortNames = names => {
        const split = names.map(name => name.split(' '));
        let common = 0;
        while (names.length > 1 && split.every(words => words.length > common + 1 && words[common] === split[0][common])) ++common;
        return split.map(words => words.slice(common).join(' '));
    };
    /// `points 0.42×, sprites 0.47×`
    const factorList = factors => {
        const names = shortNames(factors.map(({ series, panel }) => [panel, series].filter(Boolean).join(', ')));
        return factors.map(({ text }, index) => (factors.length > 1 ? `${names[index]} ${text}` : text)).join('; ');
    };
    /// The lines below the chart.
    const keyOf = ({ marks, factors }, bandList) => {
        const lines = distinct(marks.map(mark => mark.hardware)).map(hardware => `Hollow marks: published, ${hardware}.`);
        if (factors.length) lines.push(`Dashed: the measured curve, scaled to the paper's first number: ${factorList(factors)}.`);
        lines.push(...distinct(bandList.map(band => band.hardware)).map(hardware => `Band: published without a load, ${hardware}.`));
        return lines;
    };
    return { along, bands, keyOf, isOf };
})();
