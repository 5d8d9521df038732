// The chart of an image metric against a cost. Pure, as charts.js is.
const qualityChart = (() => {
    const { themes, withUnit } = chartStyle;
    const { columnOf, axisTitle, shown, isWhole, valueOf, variantOf, worldOf, inOrder, distinct, metricsOf } = chartData;
    const { seriesStyles, fresh, setSignals, setData, setScale, panelsWithin, legendColumns, legendLines, domainOf, logTicks, setTicks, spans, intervalText, missing, tableOf } = chartParts;

    /// The points to which every other point compares with a higher cost or a larger error, by intervals that do not overlap.
    const frontOf = (points, high) => {
        const errsMore = (other, point) => (high ? other.yHigh < point.yLow : other.yLow > point.yHigh);
        return points.filter(point => points.every(other => other === point || other.xLow > point.xHigh || errsMore(other, point)));
    };

    /// The costs in which the compared settings differ. Against any other cost, all points would lie on one vertical line.
    const chargesOf = (report, experiment) => {
        const judged = experiment.cells.filter(cell => metricsOf(report, { ...experiment, cells: [cell] }).length);
        return chartData.chargesOf(report, experiment).filter(name => distinct(judged.map(cell => valueOf(cell, name)?.[0]).filter(value => value !== undefined)).length > 1);
    };

    const build = (report, chart) => {
        const { experiment, theme } = chart;
        const metrics = metricsOf(report, experiment);
        const opens = experiment.chart || {};
        const metric = [chart.metric, opens.column, 'flip', metrics[0]].find(name => metrics.includes(name));
        const charges = chargesOf(report, experiment);
        const against = [chart.against, opens.against, charges[0]].find(name => charges.includes(name));
        const [info, cost] = [columnOf(report, metric), columnOf(report, against)];
        const cells = inOrder(experiment, experiment.cells)
            .filter(cell => valueOf(cell, metric) && valueOf(cell, against) && !chart.hidden.has(cell.method));
        if (!cells.length) return missing;
        const points = cells.map(cell => {
            const [x, xLow, xHigh] = valueOf(cell, against).map(value => shown(value, cost.unit));
            const [y, yLow, yHigh] = valueOf(cell, metric).map(value => shown(value, info.unit));
            return {
                panel: worldOf(experiment, cell), series: variantOf(report, experiment, cell), method: cell.method, x, xLow, xHigh, y, yLow, yHigh,
                tip: {
                    title: variantOf(report, experiment, cell),
                    [info.name]: withUnit(valueOf(cell, metric)[0], info.unit),
                    [cost.name]: withUnit(valueOf(cell, against)[0], cost.unit),
                    'cost interval': intervalText(cell, valueOf(cell, against), cost.unit),
                },
            };
        });
        const panels = distinct(points.map(point => point.panel));
        // A single point has nothing to lead.
        const compared = panels.map(panel => points.filter(point => point.panel === panel)).filter(here => here.length > 1);
        const front = compared.flatMap(here => frontOf(here, info.better === 'high'));
        const budgets = against === 'method_ms_median' && experiment.budgetMs ? [{ x: experiment.budgetMs, text: `budget ${withUnit(experiment.budgetMs, cost.unit, 6, true)}` }] : [];
        const xLog = (chart.xLog ?? spans(points.map(point => point.x), 8)) && points.every(point => point.x > 0);
        // On a logarithmic axis, intervals that reach 0 end at its edge.
        const least = 0.5 * Math.min(...points.map(point => point.x));
        if (xLog) points.forEach(point => { point.xLow = Math.max(point.xLow, least); });
        // Errors of good and bad methods lie decades apart; decibels never do.
        const yLog = (chart.yLog ?? (info.better === 'low' && spans(points.map(point => point.y), 30))) && points.every(point => point.yLow > 0);
        const series = distinct(points.map(point => point.series)).map(name => ({ name, method: points.find(point => point.series === name).method }));
        const styles = seriesStyles(report, series, theme);
        const { columns, each } = panelsWithin(chart.width, panels.length);
        const spec = fresh(report.specifications.quality);
        setSignals(spec, {
            panelWidth: Math.max(each, 120), panelHeight: panels.length === 1 ? 320 : 240, panelColumns: columns, xTitle: axisTitle(cost.name, cost.unit),
            yTitle: axisTitle(info.name, info.unit), xFormat: ',.6~r', yFormat: ',.6~r', yStep: isWhole(info.unit) ? 1 : 0, frontColour: themes[theme].muted,
            legendColumns: legendColumns(chart.width, Math.max(...series.map(({ name }) => name.length)), series.length),
        });
        setData(spec, 'panels', panels.map(panel => ({ panel })));
        setData(spec, 'points', points);
        setData(spec, 'front', front);
        setData(spec, 'budgets', budgets);
        setScale(spec, 'x', { type: xLog ? 'log' : 'linear', domain: domainOf([...points.flatMap(point => [point.x, point.xLow, point.xHigh]), ...budgets.map(budget => budget.x)], xLog, false) });
        const yDomain = domainOf(points.flatMap(point => [point.y, point.yLow, point.yHigh]), yLog, info.better === 'low');
        setScale(spec, 'y', { type: yLog ? 'log' : 'linear', domain: yDomain });
        if (yLog) setTicks(spec.marks[0].axes[0], logTicks(yDomain));
        const names = series.map(({ name }) => name);
        setScale(spec, 'colour', { domain: names, range: styles.map(style => style.colour) });
        setScale(spec, 'legendText', { domain: names, range: legendLines(names, chart.width) });
        setScale(spec, 'shape', { domain: names, range: styles.map(style => style.shape) });
        const hint = info.better === 'high' ? 'Higher' : 'Lower';
        const rings = front.length ? 'Rings and line: the Pareto front. Compared with each of these, every other setting costs more or has a larger error, by intervals that do not overlap.'
            : compared.length ? 'No setting is ringed, because the intervals of the leading settings overlap.' : '';
        return { spec, notes: [`${hint} and further left is better.`, ...(rings ? [rings] : [])], table: tableOf(report, experiment, cells, [metric, against]), state: { metric, against, xLog, yLog } };
    };
    return { build, frontOf, chargesOf };
})();
