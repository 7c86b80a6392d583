"""XML that a robot's `launch/spawner.rb` emits, found without running Ruby."""
