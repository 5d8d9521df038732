// Colours, shapes and texts that all charts share. Pure, as charts.js is.
const chartStyle = (() => {
    // Distinguishable with colour blindness (after Okabe and Ito), with a contrast of 3 : 1 or more on either background.
    const methodColours = {
        light: ['#0072b2', '#c44f00', '#6a3fb5', '#b3273a', '#7a4a2b', '#1f4e9c', '#00737f', '#007a5a', '#5b6b00', '#8a6a00', '#a3458b'],
        dark: ['#58b0e8', '#ff8f52', '#b79aff', '#ff7f8d', '#d0a07a', '#8aa8ff', '#4fc3d6', '#3ecaa0', '#bccb4f', '#e2bd35', '#e394c9'],
    };
    const baselineColour = { light: '#5a5f66', dark: '#b9bec5' };
    const baseline = 'null_method';
    /// A method's index among the colours, from its name alone: the same in every report, whatever methods a build has. The
    /// factor gives each method of this project a different colour.
    const colourOf = name => [...name].reduce((sum, letter) => (sum * 1947 + letter.codePointAt(0)) % 65521, 0) % methodColours.light.length;
    const stages = ['input', 'simulate', 'build', 'sort', 'upload', 'scene', 'draw', 'wait'];
    /// Different from the methods' colours: paler on white, deeper on black.
    const stageColours = {
        light: ['#9aa1a9', '#7cc4f0', '#63cfa6', '#f2d04a', '#ea9fd2', '#d3d8dd', '#ff9450', '#f6c9a8'],
        dark: ['#8b929a', '#2b76b3', '#1d8060', '#9c7a10', '#9a3f80', '#555d66', '#c2500f', '#7d4a2b'],
    };
    const themes = {
        light: { ink: '#1b1f24', muted: '#565e67', grid: '#e4e7ea', paper: '#ffffff' },
        dark: { ink: '#e8ebee', muted: '#a9b1ba', grid: '#31373e', paper: '#1a1d21' },
    };
    const shapes = ['circle', 'square', 'triangle-up', 'diamond', 'cross', 'triangle-down', 'triangle-right', 'triangle-left'];
    const dashes = [[1, 0], [7, 3], [2, 2], [9, 3, 2, 3], [5, 2], [12, 4], [3, 5], [1, 3]];
    const font = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif";

    const configOf = theme => {
        const { ink, muted, grid, paper } = themes[theme];
        return {
            background: paper,
            font,
            axis: {
                labelColor: muted, titleColor: ink, gridColor: grid, domainColor: muted, tickColor: muted, labelFontSize: 11,
                titleFontSize: 12, titleFontWeight: 500, titlePadding: 8, labelFont: font, titleFont: font,
            },
            title: { color: ink, fontSize: 12.5, fontWeight: 600, font, subtitleColor: muted, subtitleFont: font },
            legend: { labelColor: ink, labelFontSize: 12, labelFont: font, symbolSize: 70, columnPadding: 18, rowPadding: 4, labelLimit: 0 },
            view: { stroke: null },
        };
    };

    // Texts of numbers: measurements have three digits, with trailing zeros; small whole numbers have no decimals. A limit or
    // a tick appears as it was written: `written`.
    const grouped = text => text.replace(/^(-?\d+)/, whole => whole.replace(/\B(?=(\d{3})+$)/g, ','));
    const digits = (value, count = 3, written = false) => {
        if (value === null || value === undefined || !Number.isFinite(value)) return '–';
        const size = Math.abs(value);
        if (size !== 0 && (size < 1e-3 || size >= 1e9)) {
            const [factor, power] = (written ? Number(value.toPrecision(count)).toExponential() : value.toExponential(count - 2)).split('e');
            const raised = [...power.replace('+', '')].map(letter => '⁰¹²³⁴⁵⁶⁷⁸⁹'[letter] || '⁻').join('');
            return `${written && Math.abs(factor) === 1 ? factor.replace('1', '') : `${factor}·`}10${raised}`.replace('-', '−');
        }
        const isWhole = Number.isInteger(value);
        const text = isWhole && (written || size < 1e4) ? String(value) : value.toPrecision(count);
        return grouped(isWhole || written || text.includes('e') ? String(Number(text)) : text).replace('-', '−');
    };
    /// The number that `digits` shows.
    const said = (value, count, written = false) => {
        const size = Math.abs(value);
        if (!written && size !== 0 && (size < 1e-3 || size >= 1e9)) return Number(value.toExponential(count - 2));
        return Number.isInteger(value) && (written || size < 1e4) ? value : Number(value.toPrecision(count));
    };
    /// A space without a line break, between a number and its unit.
    const gap = '\u00a0';
    /// The unit of bytes that leaves one to three digits before the point.
    const bytesText = (value, count, written) => {
        const step = Math.min(Math.max(Math.floor(Math.log10(Math.abs(value) || 1) / 3), 0), 3);
        return `${digits(value / 1000 ** step, count, written)}${gap}${['bytes', 'kB', 'MB', 'GB'][step]}`;
    };
    /// A number in another unit, without the rounding errors of the factor.
    const times = (value, factor) => Number((value * factor).toPrecision(12));
    const withUnit = (value, unit, count = 3, written = false) => {
        if (value === null || value === undefined || !Number.isFinite(value)) return '–';
        if (unit === 'bytes') return bytesText(value, count, written);
        if (unit === 'ms' && value !== 0 && Math.abs(value) < 0.1) return `${digits(times(value, 1000), count, written)}${gap}µs`;
        if (unit.startsWith('share')) return `${digits(times(value, 100), count, written)}${gap}%${unit.slice('share'.length)}`;
        if (unit === '×') return `${digits(value, count, written)}×`;
        return digits(value, count, written) + (unit && unit !== '1' ? gap + unit : '');
    };

    const mixed = (from, to, share) => {
        const part = (text, at) => parseInt(text.slice(at, at + 2), 16);
        return '#' + [1, 3, 5].map(at => Math.round(part(from, at) + share * (part(to, at) - part(from, at)))
            .toString(16).padStart(2, '0')).join('');
    };
    return { methodColours, baselineColour, baseline, colourOf, stages, stageColours, themes, shapes, dashes, configOf, digits, said, withUnit, gap, mixed };
})();
