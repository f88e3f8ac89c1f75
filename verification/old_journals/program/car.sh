#!/bin/sh
# A mass of 350 kg on a spring (N/mm) and a damper (N s/m) rolls off a step of 30 mm: response.csv. Less than critical damping.
read -r spring damper < car.txt
awk -v k="$spring" -v c="$damper" 'BEGIN {
  m = 350; w = sqrt(1000 * k / m); z = c / (2 * m * w); d = w * sqrt(1 - z * z)
  print "time [s],body [mm]"
  for (i = 0; i <= 60; ++i) {
    t = 0.025 * i
    printf "%.3f,%.9g\n", t, -30 * (1 - exp(-z * w * t) * (cos(d * t) + z * w / d * sin(d * t)))
  }
}' > response.csv
