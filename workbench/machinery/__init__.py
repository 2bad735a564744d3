"""What knows no geometry: processes, threads, files written whole, hosts.

- `workers`: processes that share out work. They end with it, and with the process that started
  them, however that ends.
- `threads`: how numpy's libraries compute in this process and in those that it starts: threads,
  and the same to the last bit.
- `progress`: one line on a terminal that says how far something is; silent where the stream is no
  terminal.
- `atomic`: writes a file whole or not at all, and removes what a writer that was killed left
  behind.
- `hosts`: where a server of this machine listens, and which hosts a browser may name that asks
  it.
- `authors`: says where an author's code went wrong: one line with its file and line for people,
  the traceback for a terminal.
- `images`: images as the bytes of files.
- `version`: the version of this workbench.
"""
