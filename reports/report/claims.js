// The rows of the table of claims.
const claimTable = (() => {
    const { element, put, plural } = pageKit;

    /// Where the measured interval lies to the values in which the claim is true, as a small picture.
    const claimRange = claim => {
        if (claim.measured === null || (claim.min === null && claim.max === null)) return '';
        const marks = [claim.measured, claim.low, claim.high, claim.min, claim.max].filter(value => value !== null);
        let [low, high] = [Math.min(...marks), Math.max(...marks)];
        const log = low > 0 && high / low > 4;
        const bend = value => (log ? Math.log(value) : value);
        [low, high] = [bend(low), bend(high)];
        const room = (high - low) * 0.12 || 1;
        const at = value => 150 * (bend(value) - low + room) / (high - low + 2 * room);
        const shape = (tag, attributes) => {
            const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
            for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
            return made;
        };
        const svg = shape('svg', { viewBox: '0 0 150 22', class: 'claim-range', role: 'img' });
        const [from, to] = [claim.min === null ? 0 : at(claim.min), claim.max === null ? 150 : at(claim.max)];
        put(svg, shape('title', {}), shape('rect', { x: from, y: 2, width: Math.max(to - from, 1), height: 18, fill: 'var(--good)', 'fill-opacity': 0.2 }));
        svg.firstChild.textContent = `green: ${claim.expected}; measured ${chartKit.fourDigits(claim.measured)}`;
        for (const bound of [claim.min, claim.max])
            if (bound !== null) put(svg, shape('line', { x1: at(bound), x2: at(bound), y1: 2, y2: 20, stroke: 'var(--good)', 'stroke-width': 1.5 }));
        if (claim.low !== null) put(svg, shape('line', { x1: at(claim.low), x2: at(claim.high), y1: 11, y2: 11, stroke: 'var(--ink)', 'stroke-width': 2 }));
        put(svg, shape('circle', { cx: at(claim.measured), cy: 11, r: 4, fill: 'var(--ink)' }));
        return svg;
    };
    const expectedOf = ({ min, max, expected }, number) => {
        if (min !== null && max !== null) return `${number(min)} to ${number(max)}`;
        return min !== null ? `${number(min)} or more` : max !== null ? `${number(max)} or less` : expected;
    };
    const verdictMarks = { confirmed: '✓', refuted: '✗', depends: '±', unresolved: '?', untestable: '!', 'not-tested': '–' };
    const controlTexts = { turned: 'control turned', 'not-turned': 'control did not turn', 'not-run': 'control not run' };

    /// What another verdict would take.
    const whatWouldChange = (claim, number) => {
        const { min, max } = claim;
        const outside = [min !== null && `below ${number(min)}`, max !== null && `above ${number(max)}`].filter(Boolean).join(' or ');
        if (claim.verdict === 'confirmed') return `Values ${outside} would refute it.`;
        if (claim.verdict === 'refuted') return `Values of ${expectedOf(claim, number)} would confirm it.`;
        if (claim.verdict === 'unresolved' && claim.over) return `Narrower intervals, by more ${claim.over}, would decide it.`;
        if (claim.verdict === 'depends') return 'It would hold, or not, if all cells agreed.';
        return '';
    };
    /// How a claim was tested, with what controls, cell by cell.
    const detailsOf = (claim, number) => {
        const box = element('details', {}, [element('summary', { textContent: 'how it was tested' })]);
        const lines = [
            ['Measured', claim.quantity + (claim.over ? `, over ${claim.over}` : '')], ['Why these limits', claim.reason],
            ['Control', claim.controls], ['What would change it', whatWouldChange(claim, number)],
        ];
        for (const [head, text] of lines)
            if (text) put(box, element('div', {}, [element('b', { textContent: `${head}: ` }), text]));
        if (claim.cells.length > 1)
            put(box, element('ul', {}, claim.cells.map(cell => element('li', {
                className: `verdict ${cell.verdict}`,
                textContent: `${verdictMarks[cell.verdict]} ${cell.text}: ${number(cell.measured)}${cell.low === null ? '' : ` [${number(cell.low)}, ${number(cell.high)}]`}`,
            }))));
        return box;
    };

    /// `runLinks`: makes links to runs by their indices.
    const row = (report, claim, runLinks) => {
        const experiment = report.data.experiments.find(item => item.suite === claim.suite);
        const isBytes = claim.column && chartKit.columnOf(report, claim.column).unit === 'bytes';
        const number = value => (isBytes ? chartKit.withUnit(value, 'bytes') : chartKit.fourDigits(value));
        const interval = claim.low === null ? '' : ` [${number(claim.low)}, ${number(claim.high)}]`;
        const text = element('div', {}, [claim.text]);
        if (claim.condition) put(text, element('div', { textContent: claim.condition }));
        if (claim.note) put(text, element('div', { className: 'muted', textContent: claim.note }));
        if (claim.quantity) put(text, detailsOf(claim, number));
        const links = element('div');
        if (experiment) put(links, element('a', { href: `#experiment-${experiment.id}`, textContent: experiment.suite }));
        if (claim.runs.length) put(links, runLinks(claim.runs, plural(claim.runs.length, 'run')));
        return [
            element('b', { textContent: claim.id }),
            element('div', {}, [
                element('span', { className: `verdict ${claim.verdict}`, textContent: `${verdictMarks[claim.verdict]} ${claim.verdict}` }),
                element('div', { className: 'muted', textContent: controlTexts[claim.control] || '' }),
            ]),
            text, claim.measured === null ? '' : `${number(claim.measured)}${interval}`, expectedOf(claim, number), claimRange(claim), links.children.length ? links : '',
        ];
    };
    const heads = [['claim'], ['verdict'], ['what the paper says', 'wide'], ['measured [interval]', 'number', 'measured'], ['true if', '', 'true if'], [''], ['chart, runs']];
    return { row, heads };
})();
