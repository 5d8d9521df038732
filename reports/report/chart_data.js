// What charts ask of the report's data: names, values and orders of cells. Pure, as charts.js is.
const chartData = (() => {
    // What is known of a column, of a cell.
    const columnOf = (report, name) => report.columns[name] || { name, unit: '', better: '' };
    const axisTitle = (name, unit) => name + (unit === 'bytes' ? ' [MB]' : unit ? ` [${unit}]` : '');
    const shown = (value, unit) => (unit === 'bytes' ? value / 1e6 : value);
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
    const settingText = (axis, value) => `${axis.name} ${value}${axis.unit && axis.unit !== axis.name ? ' ' + axis.unit : ''}`;
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
    const distinct = list => [...new Set(list)];


    // Loads that a cost can be drawn against; where nothing that varies is a number, whatever varies.
    const loadsOf = experiment => {
        const all = experiment.axes.filter(axis => !['seed', 'frames'].includes(axis.name));
        const numbers = all.filter(axis => axis.numeric);
        return (numbers.length ? numbers : all).sort(byUse);
    };
    const byUse = (a, b) => ((b.name === 'particles') - (a.name === 'particles') || b.world - a.world || b.values.length - a.values.length);
    const costsOf = (report, experiment) => Object.keys(report.columns).filter(name => report.columns[name].cost &&
        experiment.cells.some(cell => valueOf(cell, name)));
    const metricsOf = (report, experiment) => Object.keys(report.columns).filter(name => report.columns[name].metric &&
        experiment.cells.some(cell => valueOf(cell, 'flip')) && experiment.cells.some(cell => valueOf(cell, name)));
    return { columnOf, axisTitle, shown, valueOf, settingText, variantOf, worldOf, inOrder, distinct, loadsOf, costsOf, metricsOf };
})();
