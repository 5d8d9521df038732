// Node draws one chart as SVG: `node SCRIPT ID FILE`. The code before this in the script is that of the page.
(async () => {
    const [, , id, file] = process.argv;
    const report = { data: reportData, columns: reportColumns, specifications: reportCharts };
    const chart = chartKit.list(report).find(item => item.id === id);
    const { spec, config, empty } = chart ? chartKit.build(report, chart) : { empty: `no chart '${id}'` };
    if (empty) throw new Error(empty);
    const view = new vega.View(vega.parse(spec, config, { ast: true }), { renderer: 'none', expr: vega.expressionInterpreter });
    require('fs').writeFileSync(file, await view.toSVG() + '\n');
})().catch(error => {
    console.error(error.message.split('\n')[0]);
    process.exit(1);
});
