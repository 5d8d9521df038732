// Reads the report's data for charts and tables: names, values and order of configurations. Pure, as charts.js is.
const chartData = (() => {
    const distinct = list => [...new Set(list)];
    const factOf = (report, name) => (report.data.facts || []).find(fact => fact.name === name);
    /// Name and unit of a column of summary.csv, from columns.json or from the method that declares it.
    const columnOf = (report, name) => {
        if (report.columns[name]) return report.columns[name];
        const fact = factOf(report, name);
        return { name: name.replace(/_(median|bytes|ms)$/, '').replace(/_/g, ' '), unit: fact ? fact.unit.replace(/^1$/, '') : '', better: '' };
    };
    /// `primitives drawn` needs no unit after it.
    const axisTitle = (name, unit) => {
        const text = name.replace(/_/g, ' ');
        if (!unit || text.split(' ').includes(unit)) return text;
        return text + (unit === 'bytes' ? ' [MB]' : unit.startsWith('share') ? ` [%${unit.slice('share'.length)}]` : ` [${unit}]`);
    };
    const shown = (value, unit) => (unit === 'bytes' ? value / 1e6 : unit.startsWith('share') ? 100 * value : value);
    const isWhole = unit => ['particles', 'hits', 'parts', 'primitives', 'steps', 'systems'].includes(unit);

    const valueOf = (cell, column) => {
        if (column === 'memory_bytes') {
            const [cpu, gpu] = [valueOf(cell, 'cpu_bytes'), valueOf(cell, 'gpu_bytes')];
            return cpu && gpu ? cpu.map((value, index) => value + gpu[index]) : null;
        }
        const value = cell.values[column];
        if (value === undefined || value === null) return null;
        return Array.isArray(value) ? value : [value, value, value];
    };
    const machineLabel = (report, cell) => (report.data.machines.length > 1 ? ` (machine ${cell.machine + 1})` : '');
    const sized = text => text.replace(/(\d)x(?=\d)/g, '$1×');
    const settingText = (axis, value) => `${axis.name} ${sized(value)}${axis.unit && axis.unit !== axis.name ? ' ' + axis.unit : ''}`;
    /// No line break between a number and its unit.
    const tied = text => text.replace(/(\d) (?=[^\s,\d][^\s,]*(?:,|$))/g, '$1\u00a0');
    const settingsText = (axes, cell) => axes.filter(axis => cell.settings[axis.name])
        .map(axis => settingText(axis, cell.settings[axis.name])).join(', ');
    const variantOf = (report, experiment, cell, except) => {
        const own = experiment.axes.filter(axis => !axis.world && axis.name !== except);
        const text = settingsText(own, cell);
        return cell.method + (text ? ', ' + text : '') + machineLabel(report, cell);
    };
    const worldOf = (experiment, cell, except) =>
        settingsText(experiment.axes.filter(axis => axis.world && axis.name !== except), cell);
    /// By world, method and settings, in the order of the axes' values.
    const inOrder = (experiment, cells) => {
        const by = axes => (a, b) => {
            for (const axis of axes) {
                const apart = axis.values.indexOf(a.settings[axis.name]) - axis.values.indexOf(b.settings[axis.name]);
                if (apart) return apart;
            }
            return 0;
        };
        const [world, own] = [true, false].map(is => by(experiment.axes.filter(axis => axis.world === is)));
        const method = (a, b) => (a.method < b.method ? -1 : a.method > b.method ? 1 : 0);
        return [...cells].sort((a, b) => world(a, b) || method(a, b) || own(a, b) || a.machine - b.machine);
    };

    // Configurations that differ only in the seed become one, with the median over the seeds and its interval.

    /// Median, and the order statistics that contain the true one with 95 % probability; the range below 6 values
    /// (bench/report/median_interval.h).
    const medianInterval = values => {
        const sorted = [...values].sort((a, b) => a - b);
        const n = sorted.length;
        let term = 2 ** -n, below = term, rank = 1;
        for (let i = 1; 2 * (i + 1) <= n + 1; ++i) {
            term *= (n - i + 1) / i;
            if (1 - 2 * (below + term) < 0.95) break;
            below += term;
            rank = i + 1;
        }
        const middle = (sorted[Math.floor((n - 1) / 2)] + sorted[Math.floor(n / 2)]) / 2;
        return { values: [middle, sorted[rank - 1], sorted[n - rank]], probability: 1 - 2 * below };
    };
    const mergedCell = cells => {
        const { seed, ...settings } = cells[0].settings;
        if (cells.length === 1) return { ...cells[0], settings, seeds: 1 };
        const values = {};
        for (const column of distinct(cells.flatMap(cell => Object.keys(cell.values))))
            values[column] = medianInterval(cells.map(cell => valueOf(cell, column)).filter(Boolean).map(value => value[0])).values;
        const probability = medianInterval(cells.map((cell, index) => index)).probability;
        return { ...cells[0], settings, values, probability, seeds: cells.length, runs: cells.flatMap(cell => cell.runs), failed: cells.reduce((sum, cell) => sum + cell.failed, 0) };
    };
    const overSeeds = experiment => {
        if (!experiment.axes.some(axis => axis.name === 'seed')) return experiment;
        const axes = experiment.axes.filter(axis => axis.name !== 'seed');
        const groups = new Map();
        for (const cell of experiment.cells) {
            const key = JSON.stringify([cell.method, cell.machine, ...axes.map(axis => cell.settings[axis.name])]);
            groups.set(key, [...(groups.get(key) || []), cell]);
        }
        return { ...experiment, axes, cells: [...groups.values()].map(mergedCell), fits: [] };
    };

    // Loads are settings that vary and that every configuration has, or that the suite names for its chart, numbers first.
    const byUse = (a, b) => b.numeric - a.numeric || (b.name === 'particles') - (a.name === 'particles') || b.world - a.world || b.values.length - a.values.length;
    const loadsOf = experiment => experiment.axes.filter(axis => !['seed', 'frames'].includes(axis.name) &&
        (axis.name === (experiment.chart || {}).against ||
            experiment.cells.every(cell => cell.settings[axis.name] !== undefined || cell.method === chartStyle.baseline))).sort(byUse);
    const has = (experiment, name) => experiment.cells.some(cell => valueOf(cell, name));
    const known = (report, experiment, kind) => Object.keys(report.columns).filter(name => report.columns[name][kind] && has(experiment, name));
    const costsOf = (report, experiment) => known(report, experiment, 'cost');
    const metricsOf = (report, experiment) => (has(experiment, 'flip') ? known(report, experiment, 'metric') : []);
    /// The costs that image error can be plotted against. Runs without times have only memory and primitives.
    const charges = ['frame_ms_median', 'method_ms_median', 'memory_bytes', 'gpu_bytes', 'cpu_bytes', 'bits_per_pixel', 'bytes_per_fragment', 'primitives_median'];
    const chargesOf = (report, experiment) => charges.filter(name => costsOf(report, experiment).includes(name));
    /// Whether the suite's `chart` is one of error against cost: the page then shows it first.
    const opensOnCost = experiment => charges.includes((experiment.chart || {}).against);
    /// Everything that a chart can show: costs, metrics, and columns that methods declare.
    const quantitiesOf = (report, experiment) => distinct([...costsOf(report, experiment), ...known(report, experiment, 'metric'),
        ...(report.data.facts || []).map(fact => fact.name).filter(name => has(experiment, name))]);
    return { columnOf, axisTitle, shown, isWhole, valueOf, sized, settingText, tied, variantOf, worldOf, inOrder, distinct, overSeeds, loadsOf, costsOf, metricsOf, quantitiesOf, chargesOf, opensOnCost, factOf };
})();
