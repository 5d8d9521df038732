// Shared by the builders of charts: colours of series, panels, scales, rows of bars. Pure, as charts.js is.
const chartParts = (() => {
    const { methodColours, baselineColour, baseline, colourOf, themes, shapes, dashes, digits, withUnit, mixed } = chartStyle;
    const { valueOf, variantOf, worldOf, inOrder, distinct } = chartData;

    /// Colours by method name. If two methods on a page get the same colour, the later in the alphabet takes the next one.
    const coloursOf = report => {
        const taken = new Map();
        const names = distinct(report.data.experiments.flatMap(item => item.cells.map(cell => cell.method))).filter(name => name !== baseline);
        for (const name of names.sort()) {
            let place = colourOf(name);
            for (let tries = 0; taken.has(place) && tries < methodColours.light.length; ++tries) place = (place + 1) % methodColours.light.length;
            taken.set(place, name);
        }
        return new Map([...taken].map(([place, name]) => [name, place]));
    };
    const methodColour = (report, method, theme) => {
        if (method === baseline) return baselineColour[theme];
        const places = report.colours || (report.colours = coloursOf(report));
        return methodColours[theme][places.get(method) ?? colourOf(method)];
    };
    /// Variants of a method share its colour, from light to dark (dark to light on black), and differ in shape and dashes.
    const seriesStyles = (report, series, theme) => {
        const perMethod = Object.create(null); // a method may have the name of a property that every object has
        for (const { method } of series) perMethod[method] = (perMethod[method] || 0) + 1;
        const counted = Object.create(null);
        return series.map(({ method }) => {
            const index = counted[method] = (counted[method] ?? -1) + 1;
            const share = perMethod[method] > 1 ? 0.55 * index / (perMethod[method] - 1) : 0;
            return {
                colour: mixed(methodColour(report, method, theme), themes[theme].ink, share),
                shape: shapes[index % shapes.length],
                dash: dashes[index % dashes.length],
            };
        });
    };

    /// Node has no fonts, so Vega assumes this letter width there, in font sizes.
    const letterWidth = 0.8;
    /// Breaks a sentence into lines that fit this width in pixels, of 28 letters or more.
    const wrapped = (text, width, fontSize) => {
        const letters = Math.max(Math.floor(width / (letterWidth * fontSize)), 28);
        return text.split(' ').reduce((lines, word) => {
            const last = lines[lines.length - 1];
            if (last !== undefined && last.length + 1 + word.length <= letters) lines[lines.length - 1] = `${last} ${word}`;
            else lines.push(word);
            return lines;
        }, []);
    };

    const fresh = specification => JSON.parse(JSON.stringify(specification));
    const setSignals = (spec, values) => {
        for (const signal of spec.signals) if (signal.name in values) signal.value = values[signal.name];
    };
    const setData = (spec, name, values) => { spec.data.find(item => item.name === name).values = values; };
    const setScale = (spec, name, values) => Object.assign(spec.scales.find(item => item.name === name), values);
    const panelsWithin = (width, panels) => {
        const columns = panels === 1 || width < 620 ? 1 : panels === 2 || panels === 4 || width < 900 ? 2 : 3;
        return { columns, each: Math.floor((width - 8 - (columns - 1) * 26) / columns - 66) };
    };
    /// As many columns as fit, reduced so that the rows are evenly filled: Vega fills them row by row.
    const legendColumns = (width, longest, count) => {
        const most = Math.max(Math.floor(width / (longest * 7.2 + 46)), 1);
        return Math.ceil(count / Math.ceil(count / most));
    };
    /// Names in lines that fit a legend of this width, broken after commas.
    const legendLines = (names, width) => {
        const most = Math.floor((width - 46) / 7.2);
        return names.map(name => name.split(/(?<=,) /).reduce((lines, part) => {
            const last = lines[lines.length - 1];
            if (last !== undefined && last.length + 1 + part.length <= most) lines[lines.length - 1] = `${last} ${part}`;
            else lines.push(part);
            return lines;
        }, []).join('\n'));
    };
    const domainOf = (values, log, zero) => {
        const finite = values.filter(value => Number.isFinite(value) && (!log || value > 0));
        if (!finite.length) return [log ? 1 : 0, 10];
        let [min, max] = [Math.min(...finite), Math.max(...finite)];
        if (log) return [min / 1.2, max * 1.2];
        const room = (max - min) * 0.06 || Math.abs(max) * 0.1 || 1;
        return [zero && min >= 0 ? 0 : min - room, max + room];
    };
    /// Ticks of a logarithmic axis: 1, 2 and 5 of each power of ten, of many powers only 1. Undefined for less than one.
    const logTicks = ([low, high]) => {
        const powers = Math.log10(high / low);
        if (powers < 1) return undefined;
        const factors = powers > 2.5 ? [1] : [1, 2, 5];
        const ticks = [];
        for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power) ticks.push(...factors.map(factor => Number((factor * 10 ** power).toPrecision(1))));
        return ticks.filter(tick => tick >= low && tick <= high);
    };
    /// All of these ticks except those whose labels would overlap. Vega drops every other tick beyond tickCount.
    const setTicks = (axis, values) => values && Object.assign(axis, { values, tickCount: values.length });
    const spans = (values, factor) => {
        const above = values.filter(value => value > 0);
        return above.length === values.length && Math.max(...above) / Math.min(...above) >= factor;
    };
    /// `96 to 98 ms, 96 % interval of the median, 6 runs`
    const intervalText = (cell, [, low, high], unit) => {
        const of = cell.seeds > 1 ? cell.seeds : cell.runs.length;
        if (of < 2) return 'one run';
        const share = cell.probability >= 0.95 ? `, ${Math.floor(cell.probability * 100)} % interval of the median` : ', min and max';
        return `${withUnit(low, unit)} to ${withUnit(high, unit)}${share}`;
    };
    const runsText = cell => (cell.seeds > 1 ? `${cell.runs.length} with ${cell.seeds} seeds` : String(cell.runs.length));
    const missing = { empty: 'The current selection has no values to show.' };

    const mostRows = 16;
    /// Rows of bars: a heading for each world, a row for each configuration under it. If there are too many, only one world
    /// is shown at a time, with all values of the setting `along`.
    const rowsOf = (report, experiment, cells, asked, along) => {
        const all = inOrder(experiment, cells);
        const several = all.length > mostRows;
        const rest = cell => worldOf(experiment, cell, several ? along : '');
        const worlds = several ? distinct(all.map(rest)) : [];
        const world = worlds.includes(asked) ? asked : worlds[worlds.length - 1];
        const here = worlds.length > 1 ? all.filter(cell => rest(cell) === world) : all;
        const severalWorlds = distinct(here.map(cell => worldOf(experiment, cell))).length > 1;
        const severalVariants = distinct(here.map(cell => variantOf(report, experiment, cell))).length > 1;
        const rows = [];
        let last = null;
        for (const cell of here) {
            const of = worldOf(experiment, cell);
            if (severalWorlds && severalVariants && of !== last) rows.push({ place: rows.length, text: of, header: true });
            last = of;
            rows.push({ place: rows.length, text: severalVariants || !severalWorlds ? variantOf(report, experiment, cell) : of, header: false, cell, world: of });
        }
        return { rows, worlds: worlds.length > 1 ? worlds : [], world };
    };
    const widestText = rows => Math.max(...rows.map(row => (row.total || '').length)) * 6.4 + 14;

    /// The numbers of a chart as a table; `value` gives [value, low, high] in the column's own unit.
    const tableOf = (report, experiment, cells, quantities) => ({
        columns: [['method', ''], ['setting', ''], ['world', ''], ['runs', ''], ['seeds', ''],
            ...quantities.flatMap(name => [[name, chartData.columnOf(report, name).unit], [`${name}_low`, chartData.columnOf(report, name).unit], [`${name}_high`, chartData.columnOf(report, name).unit]])],
        rows: cells.map(cell => [cell.method, variantOf(report, experiment, cell).slice(cell.method.length).replace(/^, /, ''), worldOf(experiment, cell), cell.runs.length, cell.seeds || 1,
            ...quantities.flatMap(name => valueOf(cell, name) || [null, null, null])]),
    });
    return {
        methodColour, seriesStyles, letterWidth, wrapped, fresh, setSignals, setData, setScale, panelsWithin, legendColumns, legendLines, domainOf, logTicks, setTicks, spans, intervalText,
        runsText, missing, mostRows, rowsOf, widestText, tableOf, digits,
    };
})();
