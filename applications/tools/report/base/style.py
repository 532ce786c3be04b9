"""The style sheet of the page: desk, phone, print. Where there is room, the figures of a row stand in two columns, and a figure alone or the last
one of an odd number has its caption beside it."""

STYLE = """
:root{--ink:#1d2733;--soft:#5b6773;--line:#d5dbe1;--wash:#f4f6f8;--accent:#0072b2}
*{box-sizing:border-box}
body{margin:0 auto;max-width:82rem;padding:1rem 1.2rem 4rem;color:var(--ink);background:#fff;
 font:1rem/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
h1{font-size:1.7rem;line-height:1.2;margin:.6rem 0 .2rem;overflow-wrap:anywhere}
h2{font-size:1.25rem;margin:2.4rem 0 .6rem;padding-bottom:.25rem;border-bottom:2px solid var(--accent)}
h3{font-size:1.02rem;margin:1.4rem 0 .4rem;overflow-wrap:anywhere}
.row,section>figure:not(.wide),.row>figure:only-child:not(.wide){display:grid;column-gap:2rem;align-items:start;
 grid-template-columns:repeat(auto-fill,minmax(min(100%,34rem),1fr))}
.row>*{grid-column:1/-1;min-width:0}
.row>figure:not(.wide):not(:only-child){grid-column:auto}
.row>figure:nth-child(odd):last-child:not(.wide):not(:only-child){grid-column:1/-1;display:grid;column-gap:2rem;align-items:start;
 grid-template-columns:subgrid}
p,details{max-width:60rem}
.lead,.note,figcaption{color:var(--soft)}
nav ol{columns:3 16rem;padding-left:2rem;margin:.4rem 0}
a{color:var(--accent);text-decoration:none}
a:hover{text-decoration:underline}
.data{white-space:nowrap}
.scroll{margin:.5rem 0 1.1rem;overflow-x:auto;-webkit-overflow-scrolling:touch;max-width:100%;
 background:linear-gradient(90deg,#fff 30%,#fff0) 0 0/3rem 100%,linear-gradient(270deg,#fff 30%,#fff0) 100% 0/3rem 100%,
 linear-gradient(90deg,#1d273344,#1d273300) 0 0/.9rem 100%,linear-gradient(270deg,#1d273344,#1d273300) 100% 0/.9rem 100%;
 background-repeat:no-repeat;background-attachment:local,local,scroll,scroll}
table{border-collapse:collapse;width:auto;min-width:min(100%,40rem);font-size:.9rem;font-variant-numeric:tabular-nums}
th,td{padding:.35rem .7rem;text-align:right;border-bottom:1px solid var(--line);vertical-align:top}
td:not(.text){white-space:nowrap}
td.text{min-width:6.5rem}
.name{white-space:nowrap}
.words{white-space:normal;display:inline-block;min-width:12rem}
ul{max-width:60rem;padding-left:1.2rem}
th:first-child,td:first-child,td.text,th.text{text-align:left}
thead th{background:#e9edf1aa;border-bottom:2px solid var(--line);font-weight:600}
figure{margin:1rem 0 1.6rem}
figure img{max-width:100%;height:auto;display:block}
figcaption{font-size:.88rem;margin-top:.4rem;max-width:60rem}
.note{background:var(--wash);border-left:4px solid var(--line);padding:.5rem .8rem;font-size:.9rem;
 overflow-wrap:anywhere}
.hint{display:none}
details{margin:.5rem 0}pre{background:var(--wash);padding:.7rem;font-size:.75rem;white-space:pre-wrap;
 overflow-wrap:anywhere}
@media (max-width:38rem){nav ol{columns:1}body{padding:.6rem .7rem 3rem}th,td{padding:.3rem .4rem}
 table{font-size:.8rem}figure{margin:1rem 0 1.4rem}.words{min-width:5.5rem}td small{display:block}
 .hint{display:block;font-size:.8rem;color:var(--soft);margin:.2rem 0}td:first-child{min-width:6rem}.name{white-space:normal}}
@media print{@page{margin:16mm}body{max-width:none;padding:0;font-size:10pt}nav,details,.data,.hint{display:none}
 .row,section>figure:not(.wide),.row>figure:not(.wide){display:block}figure,table,.note{break-inside:avoid}.screen{display:none}h2,h3{break-after:avoid}.scroll{overflow:visible}
 figure img{max-height:112mm;object-fit:contain;object-position:left}
 figure.tall img{max-height:185mm}}
"""
