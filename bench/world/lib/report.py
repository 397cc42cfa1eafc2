"""report.py: what the programs of the recipes print: numbers of a feature, processor time"""
import numpy as np


def report(feature, values):
    for value in np.asarray(values, dtype=np.float64).ravel():
        print(feature, repr(float(value)))


def report_time(seconds):
    print("time %.6f" % seconds)
