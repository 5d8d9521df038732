// Claims and results as sentences: each number with its quantity and unit. Pure: nothing of the browser is used.
const words = (() => {
    const { digits, said, withUnit, gap } = chartStyle;
    const { columnOf, distinct, sized } = chartData;
    /// File names stay as they are.
    const upper = text => (/^\w+\.\w/.test(text) ? text : text.charAt(0).toUpperCase() + text.slice(1));
    const plural = (count, one, many) => `${digits(count)} ${count === 1 ? one : many || one + 's'}`;
    const listOf = texts => (texts.length < 2 ? texts.join('') : `${texts.slice(0, -1).join(', ')} and ${texts[texts.length - 1]}`);
    const nameOf = (report, column) => (column.startsWith('p.') ? column.slice(2) : columnOf(report, column).name);

    /// What the program says of cells and pictures, as the page says it: `p.grid=16x12 soft=off` → `grid 16×12, soft off`.
    const readable = text => sized((/\bfinding[= ]/.test(text) ? text.replace(/\bfinding[= ]/g, '').replace(/_/g, ' ') : text)
        .replace(/\bp\./g, '').replace(/(=\S+) (?=\w+=)/g, '$1, ').replace(/(\w)=(?=\S)/g, '$1 '));
    /// `billboard puff=texture` → `billboard, puff texture`.
    const labelText = label => readable(label.replace(/^((?:reference of )?\w+) (?=\w+=)/, '$1, '));

    /// `octree_search layout=faithful` → method and settings.
    const sideOf = text => {
        const [first, ...rest] = text.split(' ').filter(Boolean);
        const settings = (first && first.includes('=') ? [first, ...rest] : rest).map(item => readable(item).replace(/\|/g, ' or '));
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

    /// How many parts the names of findings have in common before what tells them apart.
    const commonParts = names => {
        const parts = names.map(name => name.split('_'));
        let common = 0;
        while (parts.length > 1 && parts.every(part => common < part.length - 1 && part[common] === parts[0][common])) ++common;
        return common;
    };
    /// Findings in a text about the cells of a claim, without what they have in common.
    const cellText = (claim, text) => {
        const names = claim.rule && claim.rule.quantity === 'finding' ? claim.rule.column.split('|') : [];
        // A number alone says nothing.
        const shared = commonParts(names);
        const common = names.some(name => /^\d/.test(name.split('_')[shared])) ? 0 : shared;
        const short = [...names].sort((a, b) => b.length - a.length)
            .reduce((shown, name) => shown.replaceAll(name, name.split('_').slice(common).join('_')), text);
        return readable(short);
    };
    /// `silhouette knee, mean of bunny, car and figure`: what the names have in common is said once.
    const findingText = ({ name, column }) => {
        const names = column.split('|');
        if (name) return name + (names.length > 1 ? `, mean of ${names.length} cells` : '');
        const parts = names.map(item => item.split('_'));
        if (parts.length === 1) return parts[0].join(' ');
        const common = commonParts(names);
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
            finding: () => [`${findingText(rule)} (experiment ${rule.experiment})`, rule.unit],
        };
        return kinds[rule.quantity] ? kinds[rule.quantity]() : ['', ''];
    };
    const same = (a, b) => Math.abs(a - b) <= 1e-9 * Math.max(Math.abs(a), Math.abs(b));
    const hasInterval = ({ low, high }) => low !== null && high !== null && !same(low, high);
    const mostDigits = 10;
    /// So many digits that no two numbers that differ look the same or change places, and equal ones look equal: three, or
    /// more where a measurement is close to a limit or its interval is narrow.
    const digitsFor = ({ measured, low, high }, { min, max }) => {
        const known = values => values.filter(value => value !== null && value !== undefined);
        const [taken, limits] = [known([measured, low, high]), known([min, max])];
        const apart = count => {
            const shown = [...taken.map(value => [value, said(value, count)]), ...limits.map(value => [value, said(value, Math.max(count, 6), true)])];
            return shown.every(([a, x]) => shown.every(([b, y]) => (same(a, b) ? x === y : Math.sign(a - b) === Math.sign(x - y))));
        };
        let count = 3;
        while (count < mostDigits && !apart(count)) ++count;
        return count;
    };
    /// `33.8 [31.2, 36.4] frames/s`; each with its unit where they differ. `limits`: {min, max} of the claim.
    const measuredText = (item, unit, limits = item) => {
        // Without an interval a whole number is a count, and known to its end.
        if (!hasInterval(item) && Number.isInteger(item.measured) && unit !== 'bytes') return withUnit(item.measured, unit, 12, true);
        const textOf = value => withUnit(value, unit, digitsFor(item, limits));
        if (!hasInterval(item)) return textOf(item.measured);
        const texts = [item.measured, item.low, item.high].map(value => textOf(value).match(/^(\S+?)(\s.*)?$/));
        const [value, low, high] = texts.map(([, number]) => number);
        const units = distinct(texts.map(([, , rest]) => rest || ''));
        if (units.length === 1) return `${value} [${low}, ${high}]${units[0]}`;
        return `${textOf(item.measured)} [${textOf(item.low)}, ${textOf(item.high)}]`;
    };
    /// A limit, as it was written; in more than six digits only where the claim's numbers need them.
    const limitText = (claim, value, unit) => withUnit(value, unit, Math.max(digitsFor(claim, claim), 6), true);
    const rangeOf = (claim, unit) => {
        const [min, max] = [claim.min, claim.max].map(value => limitText(claim, value, unit));
        if (claim.min !== null && claim.max !== null) return min === max ? min : `${min} to ${max}`;
        return claim.min !== null ? `${min} or more` : claim.max !== null ? `${max} or less` : '';
    };
    /// What each control gave: `refuted, as known (40×: forty times the particles)`.
    const controlsOf = (report, claim) => {
        const texts = claim.controls.map(control => {
            if (control.verdict === 'not-tested') return `not run: ${control.why}`;
            const value = { measured: control.measured, low: null, high: null };
            const measured = control.measured === null ? 'nothing measured' : measuredText(value, quantityOf(report, control)[1], claim);
            return `${control.verdict}, ${control.verdict === control.known ? 'as known' : `known: ${control.known}`} (${measured}: ${control.why})`;
        });
        if (claim.control === 'not-turned' && claim.controls.every(control => control.verdict === control.known)) texts.push('no control can give the opposite verdict');
        return texts.join('; ');
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
        const counts = distinct(claim.cells.map(cell => cell.verdict)).map(verdict => [verdict, claim.cells.filter(cell => cell.verdict === verdict).length]);
        return `${counts.map(([verdict, count]) => `${verdict} in ${count}`).join(', ')} of ${claim.cells.length} cells`;
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
        if (turns > 1 && claim.over) parts.push(`95${gap}% interval over ${plural(turns, claim.over.replace(/s$/, ''))}`);
        else if (!claim.over) parts.push(hasInterval(claim) ? 'the same each time; the interval is that of the fit' : 'the same each time, no interval');
        return parts.join('; ');
    };
    /// What another verdict would take.
    const changeOf = (report, claim) => {
        const [, unit] = quantityOf(report, claim);
        const { min, max } = claim;
        const outside = min !== null && min === max ? `away from ${limitText(claim, min, unit)}` : [min !== null && `below ${limitText(claim, min, unit)}`, max !== null && `above ${limitText(claim, max, unit)}`].filter(Boolean).join(' or ');
        if (claim.verdict === 'confirmed') return `Intervals wholly ${outside}, in every cell, would refute it.`;
        if (claim.verdict === 'refuted') return `Intervals within ${rangeOf(claim, unit)}, in every cell, would confirm it.`;
        if (claim.verdict === 'unresolved') return `Narrower intervals${claim.over ? ` from more ${claim.over}` : ''} that lie on one side of the limit in every cell would decide it.`;
        if (claim.verdict === 'depends') return 'It would hold, or not, if all cells agreed.';
        if (claim.verdict === 'untestable') return 'A control that comes out as known would make the measurement count.';
        return '';
    };

    /// The same verdict, told of the other side.
    const turned = cell => ({
        ...cell, ratio: 1 / cell.ratio, low: 1 / cell.high, high: 1 / cell.low, verdict: { FASTER: 'SLOWER', SLOWER: 'FASTER' }[cell.verdict] || cell.verdict,
    });
    /// Verdicts of a comparison in the words of the side that takes less time, or else of its first.
    const comparisonSentence = (report, comparison, column) => {
        const isTurned = column.overall.verdict === 'SLOWER';
        const [overall, cells] = isTurned ? [turned(column.overall), column.cells.map(turned)] : [column.overall, column.cells];
        const [first, second, shared] = apart(comparison.of, comparison.with);
        const [a, b] = isTurned ? [second, first] : [first, second];
        const what = column.column.startsWith('fps') ? 'frame time' : nameOf(report, column.column);
        const of = cells.length > 1 ? `${cells.length} loads` : '';
        const tally = distinct(cells.map(cell => cell.verdict)).map(verdict => `${verdict.toLowerCase()} at ${cells.filter(cell => cell.verdict === verdict).length}`).join(', ');
        const sure = `95${gap}% interval ${digits(overall.low)}× to ${digits(overall.high)}×, ${plural(overall.pairs, 'paired round')}${of ? ` over ${of} (${tally})` : ''}`;
        const times = `${digits(overall.ratio)}×`;
        const verdicts = {
            FASTER: [`${a} has a shorter ${what} than ${b}`, `${times} that of ${b}`],
            SAME: [`${a} and ${b} have the same ${what}`, `${times}, within 2${gap}%`],
            UNRESOLVED: [`${upper(what)} of ${a} and ${b} not resolved`, `${a} / ${b} ${times}`],
        };
        const [head, detail] = verdicts[overall.verdict];
        return { head: shared ? `${head} (${shared})` : head, text: `${detail}; ${sure}.`, resolved: overall.verdict !== 'UNRESOLVED' };
    };
    return { upper, plural, listOf, quantityOf, controlsOf, rangeOf, measuredText, hasInterval, resultOf, cellsOf, testedOf, changeOf, turnsOf, comparisonSentence, overText, readable, cellText, labelText };
})();
