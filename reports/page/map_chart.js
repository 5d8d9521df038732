// Maps of claims: for which values of a number that the paper leaves open a claim is true, a panel for each claim. Rows are the values
// of that number (`along`), columns those of the speed or of another setting. Pure, as charts.js is.
const mapChart = (() => {
    const { themes, withUnit } = chartStyle;
    const { columnOf, axisTitle, distinct } = chartData;
    const { fresh, setSignals, setData, setScale, panelsWithin, wrapped } = chartParts;
    const letter = 6; // pixels of a letter in a tile
    const verdicts = ['confirmed', 'refuted', 'unresolved'];
    const marks = { confirmed: '✓', refuted: '✗', unresolved: '?' };
    const tones = { light: ['#bfe5d5', '#f8cbbd', '#e6e8eb'], dark: ['#1a5540', '#6b2c1f', '#3a4047'] };

    const isMapped = claim => Boolean(claim.rule.along) && claim.cells.length > 1 && claim.cells.every(cell => claim.rule.along in cell.at);
    const byNumber = (a, b) => Number(a) - Number(b) || (a < b ? -1 : a > b ? 1 : 0);
    const valuesOf = (claim, name) => distinct(claim.cells.map(cell => cell.at[name] ?? '')).sort(byNumber);
    /// The other settings that vary between the cells of a claim.
    const othersOf = claim => distinct(claim.cells.flatMap(cell => Object.keys(cell.at)))
        .filter(name => name !== claim.rule.along && valuesOf(claim, name).length > 1);
    /// The setting of the columns; empty: a single column.
    const acrossOf = claim => ['speed', 'particles', ...othersOf(claim)].find(name => othersOf(claim).includes(name)) || '';

    /// The maps of a report: {id, claims} for each paper and number. Claims without a second setting do not make a map.
    const listOf = report => report.data.papers.flatMap(({ id }) => {
        const claims = report.data.claims.filter(claim => claim.paper === id && isMapped(claim));
        return distinct(claims.map(claim => claim.rule.along)).map(along => ({ id: `${id}-by-${along}`, claims: claims.filter(claim => claim.rule.along === along) }));
    }).filter(({ claims }) => claims.some(acrossOf));

    const titleOf = (report, name) => {
        const axis = report.data.experiments.flatMap(experiment => experiment.axes).find(item => item.name === name);
        return axisTitle(columnOf(report, name).name, columnOf(report, name).unit || (axis && axis.unit !== name ? axis.unit : ''));
    };
    /// The tiles of a claim in a panel of this width. Settings other than rows and columns divide a tile into strips. Tiles have a number
    /// if it fits into all of them.
    const tilesOf = (report, claim, width) => {
        const across = acrossOf(claim), [, unit] = words.quantityOf(report, claim);
        const rest = othersOf(claim).filter(name => name !== across);
        const keyOf = cell => rest.map(name => cell.at[name] ?? '');
        const strips = distinct(claim.cells.map(cell => JSON.stringify(keyOf(cell)))).map(JSON.parse)
            .sort((a, b) => a.map((value, index) => byNumber(value, b[index])).find(Boolean) || 0).map(String);
        const [xs, ys] = [across ? valuesOf(claim, across) : [''], valuesOf(claim, claim.rule.along).reverse()];
        const numbered = claim.cells.map(cell => `${marks[cell.verdict]} ${withUnit(cell.measured, unit)}`);
        const isRoomy = strips.length === 1 && Math.max(...numbered.map(text => text.length)) * letter <= width / xs.length;
        return claim.cells.map((cell, index) => {
            const [x, y] = [across ? cell.at[across] ?? '' : '', cell.at[claim.rule.along]];
            return {
                panel: claim.id, x, y, column: xs.indexOf(x), row: ys.indexOf(y), verdict: cell.verdict,
                strip: strips.indexOf(String(keyOf(cell))), strips: strips.length,
                text: isRoomy ? numbered[index] : marks[cell.verdict],
                tip: { title: claim.id, at: words.readable(cell.text), verdict: cell.verdict, measured: words.measuredText(cell, unit, claim), 'true if': words.rangeOf(claim, unit) },
            };
        });
    };
    const stripsText = claim => othersOf(claim).filter(name => name !== acrossOf(claim)).map(name => `${name} ${valuesOf(claim, name).join(', ')}`).join('; ');

    /// `Gaps: true if 1× or less.`
    const limitOf = (report, claim) => {
        const { column, per } = claim.rule, [, unit] = words.quantityOf(report, claim);
        return words.upper(`${columnOf(report, column).name}${per ? ` per ${columnOf(report, per).name}` : ''}: true if ${words.rangeOf(claim, unit)}.`);
    };
    /// A panel whose texts have as many lines as those of its neighbours, so that all tiles of a row are at the same height.
    const evened = (panel, row) => {
        const most = Math.max(...row.map(({ title, lines }) => title.length + lines.length));
        return { ...panel, lines: [...panel.lines, ...Array(most - panel.title.length - panel.lines.length).fill(' ')] };
    };

    const build = (report, chart) => {
        const { claims, theme } = chart;
        const { along } = claims[0].rule;
        const { columns, each } = panelsWithin(chart.width, claims.length);
        const tiles = claims.flatMap(claim => tilesOf(report, claim, Math.max(each, 120)));
        const spec = fresh(report.specifications.map);
        setSignals(spec, { panelWidth: Math.max(each, 120), panelColumns: columns, yTitle: titleOf(report, along), ink: themes[theme].ink, paper: themes[theme].paper });
        const panels = claims.map(claim => ({
            panel: claim.id, title: wrapped(`${claim.id}: ${claim.verdictText}`, each, 12.5), lines: [...wrapped(`${words.upper(claim.text)}.`, each, 11), ...wrapped(limitOf(report, claim), each, 11)],
            xTitle: acrossOf(claim) ? titleOf(report, acrossOf(claim)) : '',
        }));
        setData(spec, 'panels', panels.map((panel, index) => evened(panel, panels.slice(index - index % columns).slice(0, columns))));
        setData(spec, 'tiles', tiles);
        setScale(spec, 'tone', { domain: verdicts, range: tones[theme] });
        const strips = distinct(claims.map(stripsText).filter(Boolean));
        const key = ['✓ true, ✗ false, ? open: the interval contains values for which the claim is true and values for which it is false.',
            ...(claims.some(claim => claim.id.endsWith('f')) ? ['Ids that end in f test our corrected model, all others the model as printed.'] : []),
            ...(strips.length ? [`Strips within a tile, from left to right: ${strips.join('; or ')}.`] : [])];
        return {
            spec, notes: [], key, state: {},
            table: { columns: [['claim', ''], [along, columnOf(report, along).unit], ['other settings', ''], ['verdict', ''], ['measured', ''], ['measured_low', ''], ['measured_high', '']],
                rows: claims.flatMap(claim => claim.cells.map(cell => [claim.id, cell.at[along],
                    Object.entries(cell.at).filter(([name]) => name !== along).map(([name, value]) => `${name}=${value}`).join(' '), cell.verdict, cell.measured, cell.low, cell.high])) },
        };
    };
    return { listOf, build };
})();
