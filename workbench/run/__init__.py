"""What a run is: its steps, a person's place in it, and the words that name it.

- `timeline`: one run as random access: its states, scenes and moments, computed when first asked
  for, kept, read-only, shared.
- `session`: one person's place in the course: which lesson, which params, which step. Knows no
  viewer; playing is the page's own.
- `questions`: answers questions: what was predicted, beside what the run says.
- `picking`: what a click in the scene means: the point, vertex or pixel nearest to the ray behind
  the cursor.
- `links`: addresses and commands that open exact moments: `?lesson=icp&start_angle=120`,
  `workbench show icp --start-angle=120`.
- `loading`: loads a lesson by the path that a person names: a single file, or a folder with
  `lesson.py` in it, anywhere.
- `listing`: the list of lessons, read off their source: importing every lesson would take five
  times as long.
- `flags`: command-line flags made from the signature of a command and the Params of a lesson,
  read by argparse.
"""
