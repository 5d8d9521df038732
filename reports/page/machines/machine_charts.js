// The charts of several machines, as Vega specifications: a line, or a row, for each machine. Pure, as charts.js is.
//
// chartKit.build(report, chart) gives {spec, config, notes, table, state} or {empty: reason}; `chart` is {id, kind,
// experiment} with any of {column, of, against, x, xLog, yLog, world, hidden, width, theme} set over it. Kinds: `ratio`, the time of
// each variant over that of another on the same machine; `times`, the measured values of each machine.
const machineData = (() => {
    const { distinct } = chartData;
    const together = 'all together';
    const hasInterval = ([, low, high]) => low !== null && high !== null;
    /// The ratio with its sides swapped: faster becomes slower.
    const inverted = side => {
        if (!side || side[0] === null) return side;
        const [ratio, low, high, pairs, verdict, reason] = side;
        const over = value => (value === null ? null : 1 / value);
        return [1 / ratio, over(high), over(low), pairs, { FASTER: 'SLOWER', SLOWER: 'FASTER' }[verdict] || verdict, reason];
    };
    /// The ratios of a column against a variant: [{variant, agreement, all, worlds, common}], sides as [ratio, low, high, pairs, verdict, reason].
    const ratiosAgainst = (experiment, column, reference) => experiment.ratios
        .filter(item => item.column === column && (item.of === reference || item.with === reference))
        .map(item => {
            const turn = item.of === reference ? inverted : side => side;
            const row = ({ world, agreement, sides }) => ({ world, agreement, sides: sides.map(turn) });
            return { variant: item.of === reference ? item.with : item.of, common: item.common, all: row(item.all), worlds: item.worlds.map(row) };
        })
        .sort((a, b) => a.variant - b.variant);
    const axisText = (axis, value) => chartData.settingText(axis, value);
    const worldText = (experiment, world, except) => experiment.axes
        .map((axis, index) => [axis, experiment.worlds[world][index]])
        .filter(([axis, value]) => value && axis.name !== except).map(([axis, value]) => axisText(axis, value)).join(', ');
    const loadsOf = experiment => experiment.axes.filter((axis, index) => axis.numeric && !['frames', 'warmup', 'threads'].includes(axis.name) &&
        experiment.worlds.every(world => world[index])).sort((a, b) => (b.name === 'particles') - (a.name === 'particles') || b.values.length - a.values.length);
    const columnsOfRatios = experiment => distinct(experiment.ratios.map(item => item.column));
    const columnsOfTimes = experiment => distinct(experiment.values.map(item => item.column));
    /// Variants with a ratio to any other.
    const comparedVariants = experiment => experiment.variants.map((variant, index) => index)
        .filter(index => experiment.ratios.some(item => item.of === index || item.with === index));
    /// Long names, shortened in the middle if they remain distinct.
    const shortLabels = report => {
        const labels = report.data.machines.map(machine => machine.label);
        const short = labels.map(label => (label.length > 34 ? `${label.slice(0, 18)}…${label.slice(-13)}` : label));
        return new Set(short).size === short.length ? short : labels;
    };
    return { together, hasInterval, ratiosAgainst, worldText, loadsOf, columnsOfRatios, columnsOfTimes, comparedVariants, shortLabels };
})();

const chartKit = (() => {
    const { methodColours, themes, shapes, dashes, configOf, digits, withUnit } = chartStyle;
    const { columnOf, axisTitle, shown, distinct } = chartData;
    const { fresh, setSignals, setData, setScale, panelsWithin, legendColumns, legendLines, domainOf, logTicks, setTicks, spans, missing } = chartParts;
    const { together, hasInterval, ratiosAgainst, worldText, loadsOf, columnsOfRatios, columnsOfTimes, comparedVariants, shortLabels } = machineData;
    const rowsForm = 'rows';
    const margin = 1.02;

    /// Colours by the sorted labels, so that the order of the folders does not matter.
    const styleOf = (report, machine, theme) => {
        const labels = report.data.machines.map(item => item.label).sort();
        const place = labels.indexOf(report.data.machines[machine].label);
        return { colour: methodColours[theme][place % methodColours[theme].length], shape: shapes[place % shapes.length], dash: dashes[place % dashes.length] };
    };
    const verdictText = verdict => (verdict ? verdict.toLowerCase() : '');
    const ratioText = side => {
        if (!side) return 'not measured';
        if (side[0] === null) return side[5];
        return `${digits(side[0])}×${hasInterval(side) ? ` [${digits(side[1])}, ${digits(side[2])}]` : ' (one run)'}`;
    };
    const ratioTip = (report, title, side, more = {}) => ({
        title, ...more, ratio: ratioText(side), pairs: String(side[3]), verdict: verdictText(side[4]) + (side[5] ? `: ${side[5]}` : ''),
    });
    const band = { min: 1 / margin, max: margin, tip: { title: 'the same within 2\u00a0%' } };

    const choose = (chart, columns) => {
        const { experiment } = chart;
        const column = columns.includes(chart.column) ? chart.column : columns[0];
        const loads = loadsOf(experiment);
        const load = chart.x === rowsForm ? undefined : loads.find(axis => axis.name === chart.x) || loads[0];
        return { column, load };
    };
    /// The worlds without the load. One is shown: `asked`, or the one with the most points.
    const worldOf = (points, asked) => {
        const worlds = distinct(points.map(point => point.rest));
        const count = world => points.filter(point => point.rest === world).length;
        const world = worlds.includes(asked) ? asked : [...worlds].sort((a, b) => count(b) - count(a))[0];
        return { worlds: worlds.length > 1 ? worlds : [], world };
    };

    /// Lines over a load: a panel for each variant, a line for each machine.
    const lines = (report, chart, points, { xTitle, yTitle, xLog, yLog, bands, zero }) => {
        const machines = distinct(points.map(point => point.machine)).sort((a, b) => a - b);
        const labels = shortLabels(report);
        const gap = Math.min(5, 24 / machines.length);
        for (const point of points) {
            point.series = labels[point.machine];
            point.line = `line ${point.machine}`;
            point.shift = gap * (machines.indexOf(point.machine) - (machines.length - 1) / 2);
        }
        const xs = distinct(points.map(point => point.x)).sort((a, b) => a - b);
        const panels = distinct(points.map(point => point.panel));
        const { columns, each } = panelsWithin(chart.width, panels.length);
        const panelWidth = Math.max(each, 120);
        const yDomain = domainOf(points.flatMap(point => [point.y, point.low, point.high]).concat(bands.flatMap(item => [item.min, item.max])), yLog, zero);
        const xRoom = (xs[xs.length - 1] - xs[0]) * 0.04 || 1;
        const spec = fresh(report.specifications.cost);
        setSignals(spec, {
            panelWidth, panelHeight: panels.length === 1 ? 320 : Math.max(170, Math.min(240, Math.round(panelWidth * 0.75))), panelColumns: columns, labelRoom: 0,
            xTitle, yTitle, xFormat: ',.6~r', yFormat: yDomain[1] >= 1e6 ? '.4~s' : ',.6~r',
            legendColumns: legendColumns(chart.width, Math.max(...machines.map(machine => labels[machine].length)), machines.length),
        });
        setData(spec, 'panels', panels.map(panel => ({ panel })));
        setData(spec, 'points', points);
        setData(spec, 'bands', bands.map(item => ({ x: null, ...item })));
        setScale(spec, 'x', xLog ? { type: 'log', domain: [xs[0] / 1.12, xs[xs.length - 1] * 1.08] } : { type: 'linear', domain: [xs[0] - xRoom, xs[xs.length - 1] + xRoom] });
        setScale(spec, 'y', { type: yLog ? 'log' : 'linear', domain: yDomain });
        const names = machines.map(machine => labels[machine]), styles = machines.map(machine => styleOf(report, machine, chart.theme));
        setScale(spec, 'legendText', { domain: names, range: legendLines(names, chart.width) });
        for (const key of ['colour', 'shape', 'dash']) setScale(spec, key, { domain: names, range: styles.map(style => style[key]) });
        if (yLog) setTicks(spec.marks[0].axes[0], logTicks(yDomain));
        if (xs.length <= 10) setTicks(spec.marks[0].axes[1], xs);
        return spec;
    };
    /// A row for each machine, under a heading for each variant.
    const rows = (report, chart, points, { xTitle, log, bands, zero }) => {
        const { ink } = themes[chart.theme];
        const labels = shortLabels(report);
        const list = [];
        for (const panel of distinct(points.map(point => point.panel))) {
            list.push({ place: list.length, text: panel, header: true });
            for (const point of points.filter(item => item.panel === panel)) {
                const { colour, shape } = styleOf(report, point.machine, chart.theme);
                list.push({ place: list.length, text: `${labels[point.machine]}: ${point.text}`, header: false, value: point.y, low: point.low, high: point.high, colour, shape, tip: point.tip });
            }
        }
        const spec = fresh(report.specifications.rows);
        spec.width = chart.width - 24;
        const domain = domainOf(points.flatMap(point => [point.y, point.low, point.high]).concat(bands.flatMap(item => [item.min, item.max])), log, zero);
        setSignals(spec, { xTitle, xFormat: domain[1] >= 1e6 ? '.4~s' : ',.6~r', ink });
        spec.height = list.length * spec.signals.find(signal => signal.name === 'rowHeight').value;
        setData(spec, 'rows', list);
        setData(spec, 'bands', bands);
        setScale(spec, 'x', { type: log ? 'log' : 'linear', domain });
        if (log) setTicks(spec.axes[0], logTicks(domain));
        return spec;
    };
    const tableOf = (report, points, head, unit, load) => ({
        columns: [['machine', ''], ['of', ''], ...(load ? [[load.name, load.unit]] : []), ['world', ''], [head, unit], [`${head}_low`, unit], [`${head}_high`, unit]],
        rows: points.map(point => [report.data.machines[point.machine].label, point.panel, ...(load ? [point.x] : []), point.rest, ...point.raw]),
    });

    const ratioPoints = (report, chart, experiment, column, reference, load) => {
        const points = [];
        const add = (item, row, rest, x) => row.sides.forEach((side, machine) => {
            if (!side || side[0] === null || chart.hidden.has(report.data.machines[machine].label)) return;
            const [y, low, high] = [side[0], side[1] ?? side[0], side[2] ?? side[0]];
            const panel = experiment.variants[item.variant].label;
            points.push({
                machine, panel, rest, x, y, low, high, raw: side.slice(0, 3), text: `${ratioText(side)}${side[5] ? '' : `, ${verdictText(side[4])}`}`,
                tip: ratioTip(report, `${panel}, ${report.data.machines[machine].label}`, side, load ? { [load.name]: x } : {}),
            });
        });
        const at = load ? experiment.axes.indexOf(experiment.axes.find(axis => axis.name === load.name)) : -1;
        for (const item of ratiosAgainst(experiment, column, reference)) {
            if (!load && item.worlds.length > 1) add(item, item.all, together);
            for (const row of item.worlds) add(item, row, worldText(experiment, row.world, load?.name), load ? Number(experiment.worlds[row.world][at]) : null);
        }
        return points;
    };
    const buildRatio = (report, chart) => {
        const { experiment } = chart;
        const { column, load } = choose(chart, columnsOfRatios(experiment));
        if (!column) return { empty: 'No world has times of two methods or settings.' };
        const asked = Number(chart.against ?? experiment.reference);
        const reference = comparedVariants(experiment).includes(asked) ? asked : experiment.reference;
        const all = ratioPoints(report, chart, experiment, column, reference, load);
        if (!all.length) return missing;
        const { worlds, world } = worldOf(all, chart.world);
        const points = all.filter(point => point.rest === world);
        const name = `${columnOf(report, column).name}, × that of ${experiment.variants[reference].label}`;
        // Rows show their values along x.
        const log = (load ? chart.yLog : chart.xLog) ?? spans(points.map(point => point.y), 3);
        const xLog = load ? chart.xLog ?? spans(points.map(point => point.x), 15) : log;
        const shape = { bands: [band], zero: false };
        const spec = load ? lines(report, chart, points, { ...shape, xTitle: axisTitle(load.name, load.unit === load.name ? '' : load.unit), yTitle: 'ratio', xLog, yLog: log })
            : rows(report, chart, points, { ...shape, xTitle: 'ratio', log });
        spec.description = `${name}, within each machine`;
        return {
            spec, notes: [`${words.upper(name)}: below 1 is faster. Each ratio compares two methods on one machine. Grey: the same within 2\u00a0%.`],
            table: tableOf(report, points, 'ratio', '', load),
            state: { column, against: String(reference), x: load ? load.name : rowsForm, worlds, world, xLog, yLog: load ? log : undefined },
        };
    };

    const buildTimes = (report, chart) => {
        const { experiment } = chart;
        const columns = columnsOfTimes(experiment);
        const { column, load } = choose({ ...chart, column: chart.column || 'fps_avg' }, columns);
        if (!column) return missing;
        const info = columnOf(report, column);
        const at = load ? experiment.axes.findIndex(axis => axis.name === load.name) : -1;
        const all = experiment.values.filter(item => item.column === column && !chart.hidden.has(report.data.machines[item.machine].label)).map(item => {
            const [y, low, high] = item.values.map(value => shown(value, info.unit));
            const of = item.of < 2 ? 'one run' : `${item.of} ${item.seeds ? 'seeds' : 'runs'}`;
            const sure = item.of < 2 ? '' : item.probability >= 0.95 ? `${Math.floor(item.probability * 100)} % interval of the median` : 'minimum and maximum';
            const panel = experiment.variants[item.variant].label;
            return {
                machine: item.machine, panel, rest: worldText(experiment, item.world, load?.name), x: load ? Number(experiment.worlds[item.world][at]) : null, y, low, high, raw: item.values,
                text: withUnit(item.values[0], info.unit),
                tip: { title: `${panel}, ${report.data.machines[item.machine].label}`, [info.name]: withUnit(item.values[0], info.unit), range: `${withUnit(item.values[1], info.unit)} to ${withUnit(item.values[2], info.unit)}`, 'measured in': of, ...(sure ? { interval: sure } : {}) },
            };
        });
        if (!all.length) return missing;
        const { worlds, world } = worldOf(all, chart.world);
        const here = all.filter(point => point.rest === world);
        const log = (load ? chart.yLog : chart.xLog) ?? spans(here.map(point => point.y), 60);
        const xLog = load ? chart.xLog ?? spans(here.map(point => point.x), 15) : log;
        const points = here.filter(point => (!log || point.low > 0) && (!load || !xLog || point.x > 0));
        if (!points.length) return { empty: 'A logarithmic scale cannot show these values: none is above 0.' };
        const shape = { bands: [], zero: true };
        const title = axisTitle(info.name, info.unit);
        const spec = load ? lines(report, chart, points, { ...shape, xTitle: axisTitle(load.name, load.unit === load.name ? '' : load.unit), yTitle: title, xLog, yLog: log })
            : rows(report, chart, points, { ...shape, xTitle: title, log });
        spec.description = `${info.name} of each machine`;
        return {
            spec, notes: ['Times of different machines: two lines differ because of the machines and their builds, not because of the methods.'], table: tableOf(report, points, column, info.unit, load),
            state: { column, x: load ? load.name : rowsForm, worlds, world, xLog, yLog: load ? log : undefined },
        };
    };

    const builders = { ratio: buildRatio, times: buildTimes };
    const build = (report, chart) => {
        const asked = { width: 900, theme: 'light', hidden: new Set(), ...chart };
        return { config: configOf(asked.theme), ...builders[asked.kind](report, asked) };
    };
    return { build, styleOf, ratioText, verdictText, rowsForm };
})();
