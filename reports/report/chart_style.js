// Colours, shapes and texts that all charts share. Pure, as charts.js is.
const chartStyle = (() => {
    // Told apart by people who see few colours (after Okabe and Ito), and against either background by 3 : 1 or more.
    const methodColours = {
        light: ['#0072b2', '#c44f00', '#007a5a', '#a3458b', '#8a6a00', '#5a5f66', '#1f4e9c', '#b3273a'],
        dark: ['#58b0e8', '#ff8f52', '#3ecaa0', '#e394c9', '#e2bd35', '#b9bec5', '#8aa8ff', '#ff7f8d'],
    };
    const stages = ['input', 'simulate', 'build', 'sort', 'upload', 'scene', 'draw', 'wait'];
    const stageColours = {
        light: ['#5a5f66', '#56b4e9', '#007a5a', '#e2bd35', '#a3458b', '#b6bec7', '#d55e00', '#eda36f'],
        dark: ['#d5d9de', '#58b0e8', '#2fa986', '#e2bd35', '#d487ba', '#5f6873', '#f07f3c', '#a8643c'],
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
            title: { color: ink, fontSize: 12.5, fontWeight: 600, font },
            legend: { labelColor: ink, labelFontSize: 12, labelFont: font, symbolSize: 70, columnPadding: 18, rowPadding: 4, labelLimit: 0 },
            view: { stroke: null },
        };
    };

    // Texts of numbers.
    const fourDigits = value => {
        if (value === null || value === undefined || !Number.isFinite(value)) return '–';
        const size = Math.abs(value);
        if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(2).replace('e+', 'e').replace('-', '−');
        const digits = size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : 3;
        return String(Number(value.toFixed(size < 1 ? 4 : digits))).replace('-', '−');
    };
    const withUnit = (value, unit) => {
        if (unit === 'bytes') return Number.isFinite(value) ? fourDigits(value / 1e6) + ' MB' : '–';
        return fourDigits(value) + (unit ? ' ' + unit : '');
    };

    const mixed = (from, to, share) => {
        const part = (text, at) => parseInt(text.slice(at, at + 2), 16);
        return '#' + [1, 3, 5].map(at => Math.round(part(from, at) + share * (part(to, at) - part(from, at)))
            .toString(16).padStart(2, '0')).join('');
    };
    return { methodColours, stages, stageColours, themes, shapes, dashes, configOf, fourDigits, withUnit, mixed };
})();
