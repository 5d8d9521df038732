// Claims and results as sentences, each number with its quantity and unit. Pure: uses no browser API.
const words = (() => {
    const { digits, said, withUnit, gap } = chartStyle;
    const { columnOf, distinct, sized } = chartData;
    /// File names stay as they are.
    const upper = text => (/^\w+\.\w/.test(text) ? text : text.charAt(0).toUpperCase() + text.slice(1));
    const plural = (count, one, many) => `${digits(count)} ${count === 1 ? one : many || one + 's'}`;
    const listOf = texts => (texts.length < 2 ? texts.join('') : `${texts.slice(0, -1).join(', ')} and ${texts[texts.length - 1]}`);
    const nameOf = (report, column) => (column.startsWith('p.') ? column.slice(2) : columnOf(report, column).name);

    /// The program's names of configurations and pictures, as the page shows them: `p.grid=16x12 soft=off` → `grid 16×12, soft off`.
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
    /// The settings in which two sides differ, and those that they share.
    const apart = (of, against) => {
        const [a, b] = [sideOf(of), sideOf(against)];
        const common = a.settings.filter(item => b.settings.includes(item));
        const same = a.method === b.method;
        const own = side => sideText({ method: same ? '' : side.method, settings: side.settings.filter(item => !common.includes(item)) }) || side.method;
        return [own(a), own(b), [...(same ? [a.method] : []), ...common].filter(Boolean).join(', ')];
    };
    /// `octree_recursive / octree_search (layout faithful)`: shared settings appear once.
    const overText = (of, against) => {
        const [a, b, shared] = apart(of, against);
        return `${a} / ${b}${shared ? ` (${shared})` : ''}`;
    };

    /// The number of leading parts that the names of findings have in common.
    const commonParts = names => {
        const parts = names.map(name => name.split('_'));
        let common = 0;
        while (parts.length > 1 && parts.every(part => common < part.length - 1 && part[common] === parts[0][common])) ++common;
        return common;
    };
    /// A text about the configurations of a claim, its findings without their common parts.
    const cellText = (claim, text) => {
        const names = claim.rule && claim.rule.quantity === 'finding' ? claim.rule.column.split('|') : [];
        // Keep the common parts where only a number would remain.
        const shared = commonParts(names);
        const common = names.some(name => /^\d/.test(name.split('_')[shared])) ? 0 : shared;
        const short = [...names].sort((a, b) => b.length - a.length)
            .reduce((shown, name) => shown.replaceAll(name, name.split('_').slice(common).join('_')), text);
        return readable(short);
    };
    /// `silhouette knee, mean of bunny, car and figure`: the common part of the names appears once.
    const findingText = ({ name, column }) => {
        const names = column.split('|');
        if (name) return name + (names.length > 1 ? `, mean of ${names.length} values` : '');
        const parts = names.map(item => item.split('_'));
        if (parts.length === 1) return parts[0].join(' ');
        const common = commonParts(names);
        return `${parts[0].slice(0, common).join(' ')}, mean of ${listOf(parts.map(part => part.slice(common).join(' ')))}`;
    };
    const perUnit = (unit, per) => (unit === per ? '×' : `${unit || '1'} per ${per || '1'}`);
    /// The quantity that a claim's rule computes, and its unit.
    const quantityOf = (report, { rule }) => {
        const name = rule.column ? nameOf(report, rule.column) + (rule.per ? ` per ${nameOf(report, rule.per)}` : '') : '';
        const of = sideText(sideOf(rule.of));
        const kinds = {
            ratio: () => [`${name}, ${overText(rule.of, rule.with)}`, '×'],
            matched: () => [`${name} at equal ${nameOf(report, rule.match)}, ${overText(rule.of, rule.with)}`, '×'],
            share: () => [`${listOf(rule.parts.map(part => nameOf(report, part)))} as a share of the ${name}, ${of}`, 'share'],
            growth: () => [`${name} at the largest ${rule.against} / at the smallest, ${of}`, '×'],
            trend: () => [`rank correlation (Kendall's τ) of the ${name} with ${rule.against}, ${of}`, ''],
            slopes: () => [`slope of the ${name} over ${rule.against}, upper half of the loads / lower half, ${of}`, '×'],
            exponent: () => [`exponent k of the ${name} = a + b·${rule.against}^k, ${of}`, ''],
            value: () => [`${name}, ${of}`, rule.per ? perUnit(columnOf(report, rule.column).unit, columnOf(report, rule.per).unit) : columnOf(report, rule.column).unit],
            finding: () => [`${findingText(rule)} (experiment ${rule.experiment})`, rule.unit],
        };
        return kinds[rule.quantity] ? kinds[rule.quantity]() : ['', ''];
    };
    const same = (a, b) => Math.abs(a - b) <= 1e-9 * Math.max(Math.abs(a), Math.abs(b));
    const hasInterval = ({ low, high }) => low !== null && high !== null && !same(low, high);
    const mostDigits = 10;
    /// The number of digits at which different numbers look different and keep their order, and equal ones look equal: three,
    /// or more where a measurement is close to a limit or its interval is narrow.
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
        // A whole number without an interval is a count: show all of its digits.
        if (!hasInterval(item) && Number.isInteger(item.measured) && unit !== 'bytes') return withUnit(item.measured, unit, 12, true);
        const textOf = value => withUnit(value, unit, digitsFor(item, limits));
        if (!hasInterval(item)) return textOf(item.measured);
        const texts = [item.measured, item.low, item.high].map(value => textOf(value).match(/^(\S+?)(\s.*)?$/));
        const [value, low, high] = texts.map(([, number]) => number);
        const units = distinct(texts.map(([, , rest]) => rest || ''));
        if (units.length === 1) return `${value} [${low}, ${high}]${units[0]}`;
        return `${textOf(item.measured)} [${textOf(item.low)}, ${textOf(item.high)}]`;
    };
    /// A limit as written, with more than six digits only where the claim's numbers need them.
    const limitText = (claim, value, unit) => withUnit(value, unit, Math.max(digitsFor(claim, claim), 6), true);
    const rangeOf = (claim, unit) => {
        const [min, max] = [claim.min, claim.max].map(value => limitText(claim, value, unit));
        if (claim.min !== null && claim.max !== null) return min === max ? min : `${min} to ${max}`;
        return claim.min !== null ? `${min} or more` : claim.max !== null ? `${max} or less` : '';
    };
    /// The result of each control: `refuted, as expected (40×: forty times the particles)`.
    const controlsOf = (report, claim) => {
        const texts = claim.controls.map(control => {
            if (control.verdict === 'not-tested') return `not run: ${control.why}`;
            const value = { measured: control.measured, low: null, high: null };
            const measured = control.measured === null ? 'nothing measured' : measuredText(value, quantityOf(report, control)[1], claim);
            return `${control.verdict}, ${control.verdict === control.known ? 'as expected' : `expected: ${control.known}`} (${measured}: ${control.why})`;
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
    /// The number of configurations with each verdict, if there are several.
    const cellsOf = claim => {
        if (claim.cells.length < 2) return '';
        const counts = distinct(claim.cells.map(cell => cell.verdict)).map(verdict => [verdict, claim.cells.filter(cell => cell.verdict === verdict).length]);
        return `${counts.map(([verdict, count]) => `${verdict} in ${count}`).join(', ')} of ${claim.cells.length} configurations`;
    };
    /// The number of configurations, their settings, and the values behind the interval.
    const testedOf = (claim, experiment) => {
        const parts = [];
        if (experiment) {
            const common = experiment.common || {};
            if (claim.cells.length > 1) parts.push(plural(claim.cells.length, 'configuration'));
            const varied = experiment.axes.filter(axis => axis.name !== 'seed' && axis.values.length <= 12)
                .map(axis => `${axis.name} ${listOf(axis.values)}${axis.unit && axis.unit !== axis.name ? ' ' + axis.unit : ''}`);
            parts.push(...varied);
            if (common.scene) parts.push(`scene ${common.scene}${common.drive ? `, drive ${common.drive}` : ''}`);
            if (common.size) parts.push(`${common.size.replace('x', '×')} pixels`);
            if (common.frames) parts.push(plural(Number(common.frames), 'frame'));
        }
        if (claim.rule.experiment) parts.push(`experiment ${claim.rule.experiment}, which needs no runs`);
        const turns = turnsOf(claim);
        if (turns > 1 && claim.over) parts.push(`95${gap}% interval over ${plural(turns, claim.over.replace(/s$/, ''))}`);
        else if (!claim.over) parts.push(hasInterval(claim) ? 'deterministic; the interval comes from the fit' : 'deterministic, no interval');
        return parts.join('; ');
    };
    /// The results that would change the verdict.
    const changeOf = (report, claim) => {
        const [, unit] = quantityOf(report, claim);
        const { min, max } = claim;
        const outside = min !== null && min === max ? `away from ${limitText(claim, min, unit)}` : [min !== null && `below ${limitText(claim, min, unit)}`, max !== null && `above ${limitText(claim, max, unit)}`].filter(Boolean).join(' or ');
        if (claim.verdict === 'confirmed') return `Intervals entirely ${outside} in every configuration would refute it.`;
        if (claim.verdict === 'refuted') return `Intervals within ${rangeOf(claim, unit)} in every configuration would confirm it.`;
        if (claim.verdict === 'unresolved') return `Narrower intervals${claim.over ? ` from more ${claim.over}` : ''}, on one side of the limit in every configuration, would decide it.`;
        if (claim.verdict === 'depends') return 'The same verdict in every configuration would confirm or refute it.';
        if (claim.verdict === 'untestable') return 'Controls with the expected verdicts would make the measurement count.';
        return '';
    };

    /// The same comparison with the sides swapped.
    const turned = cell => ({
        ...cell, ratio: 1 / cell.ratio, low: 1 / cell.high, high: 1 / cell.low, verdict: { FASTER: 'SLOWER', SLOWER: 'FASTER' }[cell.verdict] || cell.verdict,
    });
    /// The verdicts of a comparison. The faster side is the subject, or the first side if neither is faster.
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
