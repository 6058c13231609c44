# Long work: no progress bar in a pipe, one on a terminal, and a clean end on a signal.
. "$(dirname "$0")/lib.sh"
write_scene a.json 64

# Long enough for a bar on any machine.
long='render a.json -o a.pfm --stats a.stats --solver reference --directions 131072 --threads 1'

# end_with SIGNAL STATUS: sent a moment into the work, it ends with the status and leaves nothing.
end_with() {
  last="$long, then $1"
  timeout --preserve-status -s "$1" 0.3 "$dapple" $long >.stdout 2>.stderr
  status=$?
  expect_status "$2"
  check 'nothing on standard output' test ! -s .stdout
  check 'no bar in a pipe, no complaint' test ! -s .stderr
  expect_clean a.json
}
end_with INT 130
end_with TERM 143

# An earlier result survives.
echo before >a.pfm
timeout --preserve-status -s INT 0.3 "$dapple" $long >.stdout 2>.stderr
check 'the earlier file is untouched' grep -qx before a.pfm
rm a.pfm

# On a terminal: a percentage, a bar and both times, wiped at the end. The signal comes when the bar is there.
python3 - "$dapple" $long >.bar <<'END'
import os, pty, signal, subprocess, sys, threading
master, slave = pty.openpty()
child = subprocess.Popen(sys.argv[1:], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=slave)
os.close(slave)
watchdog = threading.Timer(30, child.kill)
watchdog.start()
seen = b""
try:
    while chunk := os.read(master, 4096):
        if b"left" in chunk and b"left" not in seen:
            child.send_signal(signal.SIGINT)
        seen += chunk
except OSError:
    pass
watchdog.cancel()
sys.stdout.buffer.write(seen)
sys.exit(0 if child.wait() == 130 else 1)
END
status=$?
last="$long on a terminal"
expect_status 0
check 'a bar' grep -Eaq '[0-9]+% \[#*\.*\] [0-9]+:[0-9]{2} elapsed, .* left' .bar
check 'wiped' test "$(tail -c 1 .bar)" = $'\r'
rm .bar
expect_clean a.json

finish
