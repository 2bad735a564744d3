"""What knows no geometry: processes, threads, files written whole, hosts.

- `workers`: processes that share out work, and end with it.
- `threads`: how numpy's libraries compute in this process and in those that it starts.
- `memory`: what arrays have freed, kept for the next ones or given back.
- `progress`: one line on a terminal that says how far something is.
- `atomic`: writes a file whole or not at all.
- `hosts`: where a server of this machine listens, and under which names.
- `authors`: says where an author's code went wrong.
- `images`: images as the bytes of files.
- `version`: the version of this workbench.
"""
