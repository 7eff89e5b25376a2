"""One self-contained HTML page for each study, made from the verdicts alone.

Data flows one way: verdicts and study (`build`), the page as data (`page`), its HTML (`rendering`), files
(`writing`).
"""
