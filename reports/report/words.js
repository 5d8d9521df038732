// Claims and results as sentences: each number with its quantity and unit. Pure: nothing of the browser is used.
const words = (() => {
    const { digits, withUnit } = chartStyle;
    const { columnOf, distinct } = chartData;
    /// File names stay as they are.
    const upper = text => (/^\w+\.\w/.test(text) ? text : text.charAt(0).toUpperCase() + text.slice(1));
    const plural = (count, one, many) => `${digits(count)} ${count === 1 ? one : many || one + 's'}`;
    const listOf = texts => (texts.length < 2 ? texts.join('') : `${texts.slice(0, -1).join(', ')} and ${texts[texts.length - 1]}`);
    const nameOf = (report, column) => (column.startsWith('p.') ? column.slice(2) : columnOf(report, column).name);

    /// `octree_search layout=faithful` → method and settings.
    const sideOf = text => {
        const [first, ...rest] = text.split(' ').filter(Boolean);
        const settings = (first && first.includes('=') ? [first, ...rest] : rest).map(item => item.replace('=', ' ').replace(/\|/g, ' or '));
        return { method: first && !first.includes('=') ? first : '', settings };
    };
    const sideText = ({ method, settings }) => [method, ...settings].filter(Boolean).join(', ');
    /// What tells two sides apart, and what they share.
    const apart = (of, against) => {
        const [a, b] = [sideOf(of), sideOf(against)];
        const common = a.settings.filter(item => b.settings.includes(item));
        const same = a.method === b.method;
        const own = side => sideText({ method: same ? '' : side.method, settings: side.settings.filter(item => !common.includes(item)) }) || side.method;
        return [own(a), own(b), [...(same ? [a.method] : []), ...common].filter(Boolean).join(', ')];
    };
    /// `octree_recursive / octree_search (layout faithful)`: what both sides share is said once.
    const overText = (of, against) => {
        const [a, b, shared] = apart(of, against);
        return `${a} / ${b}${shared ? ` (${shared})` : ''}`;
    };

    /// `silhouette knee, mean of bunny, car and figure`: what the names have in common is said once.
    const findingText = names => {
        const parts = names.map(name => name.split('_'));
        if (parts.length === 1) return parts[0].join(' ');
        let common = 0;
        while (parts.every(part => common < part.length - 1 && part[common] === parts[0][common])) ++common;
        return `${parts[0].slice(0, common).join(' ')}, mean of ${listOf(parts.map(part => part.slice(common).join(' ')))}`;
    };
    /// What a claim's rule computes, and the unit of it.
    const quantityOf = (report, { rule }) => {
        const name = rule.column ? nameOf(report, rule.column) + (rule.per ? ` per ${nameOf(report, rule.per)}` : '') : '';
        const of = sideText(sideOf(rule.of));
        const kinds = {
            ratio: () => [`${name}, ${overText(rule.of, rule.with)}`, '×'],
            matched: () => [`${name} at equal ${nameOf(report, rule.match)}, ${overText(rule.of, rule.with)}`, '×'],
            share: () => [`${listOf(rule.parts.map(part => nameOf(report, part)))} as a share of the ${name}, ${of}`, 'share'],
            growth: () => [`${name} at the most ${rule.against} / at the least, ${of}`, '×'],
            trend: () => [`rank correlation (Kendall's τ) of the ${name} with ${rule.against}, ${of}`, ''],
            slopes: () => [`slope of the ${name} over ${rule.against}, upper half of the loads / lower half, ${of}`, '×'],
            exponent: () => [`exponent k of the ${name} = a + b·${rule.against}^k, ${of}`, ''],
            value: () => [`${name}, ${of}`, columnOf(report, rule.column).unit],
            finding: () => [`${findingText(rule.column.split('|'))} (experiment ${rule.experiment})`, ''],
        };
        return kinds[rule.quantity] ? kinds[rule.quantity]() : ['', ''];
    };
    const hasInterval = ({ low, high }) => low !== null && high !== null && low !== high;
    /// `33.8 [31.2, 36.4] frames/s`; each with its unit where they differ.
    const measuredText = (item, unit) => {
        if (!hasInterval(item)) return withUnit(item.measured, unit);
        const texts = [item.measured, item.low, item.high].map(value => withUnit(value, unit).match(/^(\S+?)( .*)?$/));
        const [value, low, high] = texts.map(([, number]) => number);
        const units = distinct(texts.map(([, , rest]) => rest || ''));
        if (units.length === 1) return `${value} [${low}, ${high}]${units[0]}`;
        return `${withUnit(item.measured, unit)} [${withUnit(item.low, unit)}, ${withUnit(item.high, unit)}]`;
    };
    const rangeOf = ({ min, max }, unit) => {
        if (min !== null && max !== null) return `${withUnit(min, unit)} to ${withUnit(max, unit)}`;
        return min !== null ? `${withUnit(min, unit)} or more` : max !== null ? `${withUnit(max, unit)} or less` : '';
    };
    const turnsOf = claim => Math.min(...claim.cells.map(cell => cell.turns || 0));

    /// `Build time, octree_recursive / octree_search (layout faithful): 1.26× [1.19×, 1.33×]; true if 0.98× or less.`
    const resultOf = (report, claim) => {
        if (claim.measured === null) return '';
        const [quantity, unit] = quantityOf(report, claim);
        const expected = rangeOf(claim, unit);
        return `${upper(quantity)}: ${measuredText(claim, unit)}${expected ? `; true if ${expected}` : ''}.`;
    };
    /// How often each verdict came out, where there are several cells.
    const cellsOf = claim => {
        if (claim.cells.length < 2) return '';
        const texts = { confirmed: 'true', refuted: 'false', unresolved: 'open' };
        const counts = Object.keys(texts).map(verdict => [verdict, claim.cells.filter(cell => cell.verdict === verdict).length]).filter(([, count]) => count);
        return `${counts.map(([verdict, count]) => `${texts[verdict]} in ${count}`).join(', ')} of ${claim.cells.length} cells`;
    };
    /// The cells, what they share, and over what the interval is.
    const testedOf = (claim, experiment) => {
        const parts = [];
        if (experiment) {
            const common = experiment.common || {};
            if (claim.cells.length > 1) parts.push(plural(claim.cells.length, 'cell'));
            const varied = experiment.axes.filter(axis => axis.name !== 'seed' && axis.values.length <= 12)
                .map(axis => `${axis.name} ${listOf(axis.values)}${axis.unit && axis.unit !== axis.name ? ' ' + axis.unit : ''}`);
            parts.push(...varied);
            if (common.scene) parts.push(`scene ${common.scene}${common.drive ? `, drive ${common.drive}` : ''}`);
            if (common.size) parts.push(`${common.size.replace('x', '×')} pixels`);
            if (common.frames) parts.push(plural(Number(common.frames), 'frame'));
        }
        if (claim.rule.experiment) parts.push(`the experiment ${claim.rule.experiment}, which needs no runs`);
        const turns = turnsOf(claim);
        if (turns > 1 && claim.over) parts.push(`95 % interval over ${plural(turns, claim.over.replace(/s$/, ''))}`);
        else if (!claim.over) parts.push('the same each time, no interval');
        return parts.join('; ');
    };
    /// What another verdict would take.
    const changeOf = (report, claim) => {
        const [, unit] = quantityOf(report, claim);
        const { min, max } = claim;
        const outside = [min !== null && `below ${withUnit(min, unit)}`, max !== null && `above ${withUnit(max, unit)}`].filter(Boolean).join(' or ');
        if (claim.verdict === 'confirmed') return `Intervals wholly ${outside}, in every cell, would refute it.`;
        if (claim.verdict === 'refuted') return `Intervals within ${rangeOf(claim, unit)}, in every cell, would confirm it.`;
        if (claim.verdict === 'unresolved') return `Narrower intervals${claim.over ? `, by more ${claim.over}` : ''}, that lie on one side of the limit in every cell would decide it.`;
        if (claim.verdict === 'depends') return 'It would hold, or not, if all cells agreed.';
        if (claim.verdict === 'untestable') return 'A control that comes out as known would make the measurement count.';
        return '';
    };

    /// Verdicts of a comparison in the words of its first side: less time is faster.
    const comparisonSentence = (report, comparison, column) => {
        const { overall, cells } = column;
        const [a, b, shared] = apart(comparison.of, comparison.with);
        const what = column.column.startsWith('fps') ? 'frame time' : nameOf(report, column.column);
        const of = cells.length > 1 ? `${cells.length} loads` : '';
        const tally = distinct(cells.map(cell => cell.verdict)).map(verdict => `${verdict.toLowerCase()} at ${cells.filter(cell => cell.verdict === verdict).length}`).join(', ');
        const sure = `95 % interval ${digits(overall.low)}× to ${digits(overall.high)}×, ${plural(overall.pairs, 'paired round')}${of ? ` over ${of} (${tally})` : ''}`;
        const times = `${digits(overall.ratio)}×`;
        const verdicts = {
            FASTER: [`${a} has a shorter ${what} than ${b}`, `${times} that of ${b}`],
            SLOWER: [`${b} has a shorter ${what} than ${a}`, `that of ${a} is ${times} as long`],
            SAME: [`${a} and ${b} have the same ${what}`, `${times}, within 2 %`],
            UNRESOLVED: [`${a} or ${b}: not resolved`, `${what}, ${a} / ${b}: ${times}`],
        };
        const [head, detail] = verdicts[overall.verdict];
        return { head: shared ? `${head} (${shared})` : head, text: `${detail}; ${sure}.`, resolved: overall.verdict !== 'UNRESOLVED' };
    };
    return { upper, plural, listOf, quantityOf, rangeOf, measuredText, hasInterval, resultOf, cellsOf, testedOf, changeOf, turnsOf, comparisonSentence, overText };
})();
